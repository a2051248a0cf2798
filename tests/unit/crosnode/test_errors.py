"""The tree of errors: ours, theirs and unknown types can be told apart."""

import inspect

from crosnode import errors


def test_tree_is_that_of_the_docstring() -> None:
    classes = [cls for _, cls in inspect.getmembers(errors, inspect.isclass)]
    assert all(issubclass(cls, errors.CrosnodeError) for cls in classes)
    assert errors.__doc__
    assert all(cls.__name__ in errors.__doc__ for cls in classes)


def test_ours_are_not_theirs() -> None:
    for ours in (errors.LocalProtocolError, errors.MessageValueError, errors.InvalidNameError):
        assert not issubclass(ours, errors.RemoteProtocolError)
    for theirs in (errors.DecodeError, errors.TcprosError, errors.XmlRpcError, errors.LimitError):
        assert issubclass(theirs, errors.RemoteProtocolError)


def test_unknown_type_is_a_lookup_error_with_a_plain_message() -> None:
    error = errors.UnknownTypeError("No message type a/B.")
    assert isinstance(error, LookupError)
    assert str(error) == "No message type a/B."
