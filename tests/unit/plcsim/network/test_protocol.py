from __future__ import annotations

import ipaddress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.network.protocol import (
    MAX_BUFFER,
    MAX_RECEIVE_LOW,
    Address,
    Option,
    is_connectable,
    is_ipv4,
    legal_value,
)


def is_ipv4_by_standard_library(text: str) -> bool:
    try:
        ipaddress.IPv4Address(text)
    except ValueError:
        return False
    return True


@given(
    st.one_of(
        st.text(),
        st.text(alphabet="0123456789.", max_size=16),
        st.lists(st.integers(-1, 300).map(str), min_size=3, max_size=5).map(".".join),
    )
)
def test_is_ipv4_agrees_with_the_standard_library(text: str) -> None:
    assert is_ipv4(text) == is_ipv4_by_standard_library(text)


@pytest.mark.parametrize(
    ("peer", "connectable"),
    [
        (Address("192.168.0.1", 1), True),
        (Address("192.168.0.1", 65_535), True),
        (Address("192.168.0.1", 0), False),
        (Address("192.168.0.1", 65_536), False),
        (Address("0.0.0.0", 80), False),
        (Address("plc", 80), False),
    ],
)
def test_is_connectable(peer: Address, connectable: bool) -> None:
    assert is_connectable(peer) is connectable


@pytest.mark.parametrize(
    ("option", "value", "legal"),
    [
        (Option.NO_DELAY, 7, 1),
        (Option.NO_DELAY, 0, 0),
        (Option.SEND_BUFFER, 0, 1),
        (Option.SEND_BUFFER, 2**32 - 1, MAX_BUFFER),
        (Option.RECEIVE_LOW, 0, 1),
        (Option.RECEIVE_LOW, 2**31, MAX_RECEIVE_LOW),
        (Option.KEEP_COUNT, 127, 127),
        (Option.KEEP_COUNT, 128, None),
        (Option.KEEP_IDLE, 0, None),
        (Option.KEEP_INTERVAL, 32_768, None),
    ],
)
def test_legal_value(option: Option, value: int, legal: int | None) -> None:
    assert legal_value(option, value) == legal
