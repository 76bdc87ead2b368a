"""What functions of the user's raise, as texts for rows of results."""
import signal
import threading


def _is_ctrl_c(error):
    """Whether it was a key: workers ignore that one, and it comes to the main thread alone."""
    return (isinstance(error, KeyboardInterrupt) and threading.current_thread() is threading.main_thread()
            and signal.getsignal(signal.SIGINT) is not signal.SIG_IGN)


def reason(error):
    """TYPE: TEXT of anything that the user's code raised, of what would end the process too. :raises KeyboardInterrupt: if it was Ctrl-C."""
    if _is_ctrl_c(error):
        raise error
    name = type(error).__name__
    try:
        text = str(error).encode("utf-8", "backslashreplace").decode("utf-8")
    except BaseException as other:  # noqa: B036 - the user's too
        if _is_ctrl_c(other):
            raise
        text = ""
    return f"{name}: {text}" if text else name
