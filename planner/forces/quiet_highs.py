"""HiGHS without its banner.

Since 1.16 a new solver prints it while it is made: enabling its callbacks is its first work, and no option can be set
before. So the option is set on the way there.
"""

import highspy


class QuietHighs(highspy.Highs):
    """A solver that prints nothing, from its first moment."""

    def __init__(self) -> None:
        super().__init__()
        self.setOptionValue("output_flag", False)  # for versions that enable no callbacks while they are made

    def enableCallbacks(self) -> None:
        self.setOptionValue("output_flag", False)
        super().enableCallbacks()
