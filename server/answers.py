"""Answers that a browser waits for outlive the beginning of a run.

An upload asks the server where to, a download that is made when asked for asks where from. Streamlit 1.67 empties the
queue of a session when a run begins, and with it an answer that is on its way: the upload or download then never comes,
and nothing says so. Toasts were lost in the same way, and are kept there by now.
"""

from functools import wraps

from streamlit.runtime.forward_msg_queue import ForwardMsgQueue

ANSWERS = {"file_urls_response", "backend_operation_response"}


def keep_answers() -> None:
    """Once for the process; where Streamlit keeps them itself nothing changes."""
    cleared = ForwardMsgQueue.clear
    if hasattr(cleared, "__wrapped__"):
        return

    @wraps(cleared)
    def clear(self: ForwardMsgQueue, retain_lifecycle_msgs: bool = False, *more, **named) -> None:
        before = self._queue
        cleared(self, retain_lifecycle_msgs, *more, **named)
        if retain_lifecycle_msgs:
            kept = {id(message) for message in self._queue}
            answers = [each for each in before if each.WhichOneof("type") in ANSWERS and id(each) not in kept]
            self._queue[:0] = answers

    ForwardMsgQueue.clear = clear
