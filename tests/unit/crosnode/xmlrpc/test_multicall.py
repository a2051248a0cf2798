"""Many calls in one."""

from crosnode.xmlrpc.multicall import (
    INVALID_PARAMETERS,
    MAX_CALLS,
    MAX_VALUES,
    REPLY_TOO_LARGE,
    run_multicall,
    split_multicall,
)
from crosnode.xmlrpc.values import MethodCall, MethodFault, MethodResponse


def entry(method: object, params: object) -> dict[str, object]:
    return {"methodName": method, "params": params}


def test_values_and_faults_in_order() -> None:
    def answer(call: MethodCall) -> MethodResponse | MethodFault:
        return (
            MethodFault(1, "no")
            if call.method == "bad"
            else MethodResponse([call.method, *call.params])
        )

    calls = [entry("a", [1]), entry("bad", []), "no struct", {"methodName": "b"}]
    assert list(run_multicall([calls], answer)) == [
        [["a", 1]],
        {"faultCode": 1, "faultString": "no"},
        {
            "faultCode": INVALID_PARAMETERS,
            "faultString": "expected a struct of methodName and params",
        },
        [["b"]],
    ]


def test_refused() -> None:
    for params in ([], [1], [[], []], [[entry("m", [])] * (MAX_CALLS + 1)]):
        (fault,) = split_multicall(params)
        assert isinstance(fault, MethodFault)
    for call in (entry("system.multicall", [[]]), entry(1, []), entry("m", "x"), 5):
        (fault,) = split_multicall([[call]])
        assert isinstance(fault, MethodFault)


def test_a_short_call_cannot_ask_for_any_number_of_long_answers() -> None:
    asked = []

    def answer(call: MethodCall) -> MethodResponse:
        asked.append(call.method)
        return MethodResponse([[{"k": number}] for number in range(MAX_VALUES // 10)])

    found = list(run_multicall([[entry("m", [])] * MAX_CALLS], answer))
    assert len(found) == MAX_CALLS
    assert len(asked) == 4
    assert {each["faultCode"] for each in found[4:]} == {REPLY_TOO_LARGE}
