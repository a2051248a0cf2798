"""Random data types and values for the property tests."""

from hypothesis import strategies as st

from st_types import STRING, WSTRING
from st_types.types.derived import (
    AliasType,
    ArrayType,
    DataBlockType,
    EnumerationType,
    Member,
    ReferenceType,
    Section,
    StringType,
    StructType,
    SubrangeType,
    WStringType,
)
from st_types.types.elementary import ELEMENTARY, INT, UDINT, USINT, ElementaryType, Kind

elementary_types = st.sampled_from(sorted(set(ELEMENTARY.values()), key=str))

leaf_types = st.one_of(
    elementary_types,
    st.integers(1, 9).map(STRING),
    st.integers(1, 4).map(WSTRING),
    st.just(EnumerationType("Mode", {"OFF": 3, "ON": -7})),
    st.sampled_from([SubrangeType("Low", USINT, 2, 9), SubrangeType("Both", INT, -5, 5)]),
    st.just(ReferenceType(UDINT)),
)

bounds = st.tuples(st.integers(-3, 3), st.integers(0, 2)).map(lambda b: (b[0], b[0] + b[1]))


def _structs(types, kind, smallest):
    members = st.lists(st.tuples(types, st.sampled_from(Section)), min_size=smallest, max_size=6)
    return members.map(
        lambda found: kind(
            kind.__name__,
            [Member(f"m{i}", t, None, section) for i, (t, section) in enumerate(found)],
        )
    )


def _grow(types, smallest):
    return st.one_of(
        st.builds(ArrayType, types, st.lists(bounds, min_size=1, max_size=2)),
        _structs(types, StructType, smallest),
        _structs(types, DataBlockType, smallest),
        types.map(lambda t: AliasType("Alias", t)),
    )


def types_with(smallest):
    """Types whose STRUCTs have at least ``smallest`` members."""
    return st.recursive(leaf_types, lambda types: _grow(types, smallest), max_leaves=8)


def structs_with(smallest):
    """STRUCTs and data blocks with at least ``smallest`` members, also inside."""
    types = types_with(smallest)
    return _structs(types, StructType, smallest) | _structs(types, DataBlockType, smallest)


any_types = types_with(0)
struct_types = structs_with(0)


def values_of(data_type):
    """Plain values of a type, as `decode` gives them."""
    match data_type:
        case ElementaryType(kind=Kind.BOOL):
            return st.booleans()
        case ElementaryType(kind=Kind.REAL, size=size):
            return st.floats(width=8 * size, allow_nan=False)
        case ElementaryType(minimum=low, maximum=high) | SubrangeType(minimum=low, maximum=high):
            return st.integers(low, high)
        case EnumerationType():
            return st.integers(-(2**31), 2**31 - 1)
        case ReferenceType():
            return st.integers(0, 2**32 - 1)
        case StringType(length=length):
            return st.text(st.characters(min_codepoint=1, max_codepoint=255), max_size=length)
        case WStringType(length=length):
            text = st.text(st.characters(min_codepoint=1), max_size=length)
            return text.filter(lambda t: len(t.encode("utf-16-le", "surrogatepass")) <= 2 * length)
        case AliasType(target=target):
            return values_of(target)
        case ArrayType(element=element, count=count):
            return st.lists(values_of(element), min_size=count, max_size=count)
        case StructType(members=members):
            return st.fixed_dictionaries({m.name: values_of(m.data_type) for m in members})
    raise AssertionError(data_type)


def typed_values(types):
    """(type, plain value of it)."""
    return types.flatmap(lambda data_type: st.tuples(st.just(data_type), values_of(data_type)))


def typed_bytes(types):
    """(type, as many bytes as it has)."""
    return types.flatmap(
        lambda t: st.tuples(st.just(t), st.binary(min_size=t.size, max_size=t.size))
    )
