"""What a browser waits for, when a run begins: the queue is Streamlit's own."""

import pytest
from streamlit.proto.ForwardMsg_pb2 import ForwardMsg
from streamlit.runtime.forward_msg_queue import ForwardMsgQueue

from server.answers import keep_answers


@pytest.fixture
def queue():
    keep_answers()
    keep_answers()  # twice does no harm
    queue = ForwardMsgQueue()
    for kind in ("file_urls_response", "backend_operation_response", "new_session", "ref_hash"):
        message = ForwardMsg()
        if kind == "ref_hash":
            message.ref_hash = "0"
        else:
            getattr(message, kind).SetInParent()
        queue.enqueue(message)
    return queue


def kinds(messages):
    return [message.WhichOneof("type") for message in messages]


@pytest.mark.parametrize("fragments", [None, []])
def test_a_run_that_begins_keeps_answers_once_and_in_order(queue, fragments):
    queue.clear(retain_lifecycle_msgs=True, fragment_ids_this_run=fragments)
    found = kinds(queue.flush())
    assert found[:2] == ["file_urls_response", "backend_operation_response"]
    assert len(found) == len(set(found))
    assert "new_session" in found
    assert fragments is not None or "ref_hash" not in found  # what Streamlit drops is dropped


def test_what_was_sent_is_not_sent_again(queue):
    assert len(queue.flush()) == 4
    assert not queue.flush()
