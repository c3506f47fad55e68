"""A planned grasp: what it is (`grasp`), its published shape (`document`) and file, and its object read again."""
