"""Names of messages: same name, same message. Pure: no streamlit."""

import hashlib


def name_of(*what) -> str:
    """Sixteen characters that say all of `what`, by its repr."""
    return hashlib.sha256(repr(what).encode()).hexdigest()[:16]
