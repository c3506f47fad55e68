"""A number of things, as a sentence says it."""


def counted(number: int, noun: str) -> str:
    """For example "no joints", "1 joint", "12,000 joints"."""
    return f"{number:,} {noun}s" if number > 1 else f"{number or 'no'} {noun}{'' if number else 's'}"
