"""Reading and writing files, whoever made them: bounded, atomic, with one clear error."""
