"""What a finger can do at its contact: one model per file.

To add one: write its file, in the words of `contact_model`, and name it in `models`.
"""
