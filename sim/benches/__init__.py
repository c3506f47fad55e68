"""Other groups' tests of a grasp, with fingertips. Their verdicts are not about rho."""
