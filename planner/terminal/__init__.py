"""The terminal: lines that stay, progress, signals, exit codes. Only this room and the commands know it."""
