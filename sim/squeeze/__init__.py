"""Fingers that cannot adapt: the constant squeeze that holds every wrench, predicted and measured. Not rho."""
