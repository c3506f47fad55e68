"""dm_control's MJCF object model, imported without its search for a display.

A measurement draws nothing; the warning that no display was found would only alarm.
"""

import warnings

with warnings.catch_warnings():
    warnings.filterwarnings("ignore", message=".*DISPLAY environment variable is missing")
    from dm_control import mjcf

__all__ = ["mjcf"]
