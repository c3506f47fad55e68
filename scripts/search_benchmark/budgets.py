"""How much time everyone gets."""

from dataclasses import dataclass, replace


@dataclass(frozen=True, kw_only=True)
class Budgets:
    """Runs, seeds, and seconds per instance."""

    runs: int = 5
    """Runs of the certified search, of which the median counts; fewer once they have taken half a minute."""

    search_limit: float = 300.0
    """Time limit of one run of the certified search [s]."""

    verify_limit: float = 40.0
    """Time limit of the independent verifier [s]."""

    competitor: float = 15.0
    """Budget of the enumeration, and of each mixed-integer program [s]."""

    paper: float = 60.0
    """Budget of the paper's algorithm [s]; it is begun where its first pass alone fits. Case III takes some 600 s."""

    seeds: int = 20
    """Runs of each heuristic, every one as long as the certified search."""

    heuristic: float = 20.0
    """Seconds of each heuristic in all; fewer seeds where they would take longer, but never fewer than three."""

    def small(self) -> "Budgets":
        """At most seconds for each."""
        return replace(
            self,
            runs=min(self.runs, 3),
            competitor=min(self.competitor, 3.0),
            paper=min(self.paper, 3.0),
            seeds=min(self.seeds, 3),
        )
