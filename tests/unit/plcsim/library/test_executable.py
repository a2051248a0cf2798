from plcsim.library.executable import FunctionBody, function


def test_a_function_is_marked_and_else_unchanged():
    def twice(context, x):
        return 2 * x

    marked = function("Twice")(twice)
    assert marked is twice
    assert marked._plc_function == FunctionBody("Twice")
