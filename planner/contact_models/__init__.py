"""What a finger can do at its contact: one model per file.

To add one: write its file, in the words of `contact_model`; in `models`, which contacts are of it.

hard_finger       pushes and rubs, and cannot twist
soft_finger       pushes, rubs and twists
friction_cone     the cone that models share
"""
