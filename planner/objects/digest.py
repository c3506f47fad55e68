"""The digest that tells whether an object is still the one a grasp was planned on."""

import hashlib
import os
from collections.abc import Iterable
from pathlib import Path


def digest(folder: Path, files: Iterable[Path]) -> str:
    """SHA-256 over the contents of some files and their paths relative to `folder`, in the order of these paths.

    It does not depend on where the folder lies. Files that do not exist (missing textures) are left out, and what is no
    regular file is never read.
    """
    contents = {Path(os.path.relpath(file, folder)).as_posix(): file for file in files if file.is_file()}
    whole = hashlib.sha256()
    for name in sorted(contents):
        whole.update(hashlib.sha256(name.encode()).digest())
        with contents[name].open("rb") as stream:
            whole.update(hashlib.file_digest(stream, "sha256").digest())
    return whole.hexdigest()
