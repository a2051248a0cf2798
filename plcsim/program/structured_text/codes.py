"""The codes of findings in Structured Text, with what they mean and how to put it right.

A code is never given to another finding. docs/st-codes.md is written from this table.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Final, NamedTuple


class FindingCode(StrEnum):
    """Kinds of findings; ST1 text, ST2 names, ST3 types, ST4 not supported, ST5 warnings."""

    SYNTAX = "ST1001"
    DECLARATION = "ST1002"

    UNKNOWN_NAME = "ST2001"
    UNKNOWN_MEMBER = "ST2002"
    UNKNOWN_TYPE = "ST2003"
    NOT_CALLABLE = "ST2004"
    NO_VARIABLE = "ST2005"
    CONSTANT_ASSIGNED = "ST2006"
    NO_VALUE = "ST2007"
    DECLARED_TWICE = "ST2008"
    NO_DECLARATION = "ST2009"
    NOT_IN_LOOP = "ST2010"

    CANNOT_CONVERT = "ST3001"
    WRONG_OPERANDS = "ST3002"
    WRONG_ARGUMENTS = "ST3003"
    UNKNOWN_PARAMETER = "ST3004"
    NO_CONDITION = "ST3005"
    WRONG_INDEX = "ST3006"
    NO_ARRAY = "ST3007"
    NO_MEMBERS = "ST3008"
    WRONG_LABEL = "ST3009"
    LABEL_TWICE = "ST3010"
    WRONG_BIT = "ST3011"
    NO_REFERENCE = "ST3012"
    NO_ADDRESS = "ST3013"
    INDEX_OUTSIDE = "ST3014"
    VALUE_OUTSIDE = "ST3015"
    DIVISION_BY_ZERO = "ST3016"

    NOT_SUPPORTED = "ST4001"

    OTHER_CASE = "ST5001"
    UNUSED_VARIABLE = "ST5002"
    UNREACHABLE = "ST5003"
    COMPARED = "ST5004"
    NARROWED = "ST5005"
    SIGN_MIXED = "ST5006"
    NO_EFFECT = "ST5007"
    NEVER_CALLED = "ST5008"


class Explanation(NamedTuple):
    """What the page of codes says of a code.

    Attributes:
        title: what was found, in a few words.
        text: why it matters, and what to do.
        example: a statement that leads to it; may be empty.
    """

    title: str
    text: str
    example: str = ""


EXPLANATIONS: Final[dict[FindingCode, Explanation]] = {
    FindingCode.SYNTAX: Explanation(
        "The text is no Structured Text here",
        "The message says what was expected. Statements before and behind it are checked all the "
        "same, so that one run finds all errors.",
        "a := ;",
    ),
    FindingCode.DECLARATION: Explanation(
        "A declaration is wrong",
        "A type, a variable, a constant or an initial value that is declared in a file of "
        "Structured Text; `plcsim types check` tells the same of .typ, .var and .fun files.",
        "VAR a : Nowhere; END_VAR",
    ),
    FindingCode.UNKNOWN_NAME: Explanation(
        "Nothing of this name is declared",
        "Names are looked up in the unit, the program, the private packages around it, the project "
        "and its libraries, in this order. In Automation Studio's dialect case matters.",
        "speeed := 1;",
    ),
    FindingCode.UNKNOWN_MEMBER: Explanation(
        "The structure or the function block has no such member",
        "The hint names a member that differs in case or little else.",
        "motor.speeed := 1;",
    ),
    FindingCode.UNKNOWN_TYPE: Explanation(
        "A type has no layout",
        "The type of a variable is not declared, or something in it is not. What is wrong with it "
        "is told where it is declared.",
    ),
    FindingCode.NOT_CALLABLE: Explanation(
        "This cannot be called",
        "Functions, instances of function blocks and actions can be called.",
        "counter(1);",
    ),
    FindingCode.NO_VARIABLE: Explanation(
        "A variable was expected",
        "Only a variable, an element, a member or a bit of one can stand on the left of an "
        "assignment, behind `=>`, for a VAR_IN_OUT, or in ADR.",
        "a + b := 1;",
    ),
    FindingCode.CONSTANT_ASSIGNED: Explanation(
        "A constant cannot be assigned",
        "The variable is declared in a VAR CONSTANT.",
        "MAX_SPEED := 1;",
    ),
    FindingCode.NO_VALUE: Explanation(
        "This has no value",
        "The function has no result, or the name stands for a function block, an action or a type.",
        "a := timer;",
    ),
    FindingCode.DECLARED_TWICE: Explanation(
        "The same thing is there twice",
        "Two units, actions, functions or function blocks of one name; the first one counts.",
    ),
    FindingCode.NO_DECLARATION: Explanation(
        "A body without a declaration",
        "The FUNCTION or FUNCTION_BLOCK has no VAR blocks of its own, and no .fun file in reach "
        "declares it.",
    ),
    FindingCode.NOT_IN_LOOP: Explanation(
        "EXIT or CONTINUE outside a loop",
        "They belong into FOR, WHILE or REPEAT.",
        "EXIT;",
    ),
    FindingCode.CANNOT_CONVERT: Explanation(
        "The value does not go into this type by itself",
        "Use a conversion function such as REAL_TO_DINT, or declare the variable differently.",
        "flag := 'text';",
    ),
    FindingCode.WRONG_OPERANDS: Explanation(
        "The operator does not take these types",
        "Arithmetic takes numbers and times, AND, OR, XOR and NOT take BOOL and integers, "
        "comparisons take two values of one kind.",
        "a := 'x' * 2;",
    ),
    FindingCode.WRONG_ARGUMENTS: Explanation(
        "The arguments do not fit the parameters",
        "Too many, too few, one given twice, or named and unnamed ones mixed.",
        "a := LIMIT(1, 2);",
    ),
    FindingCode.UNKNOWN_PARAMETER: Explanation(
        "There is no parameter of this name",
        "A call of a function block names inputs and VAR_IN_OUT with `:=` and outputs with `=>`.",
        "timer(TIME := T#1s);",
    ),
    FindingCode.NO_CONDITION: Explanation(
        "A condition must be a BOOL",
        "IF, ELSIF, WHILE and UNTIL take a BOOL.",
        "IF 'x' THEN",
    ),
    FindingCode.WRONG_INDEX: Explanation(
        "The indices do not fit the array",
        "An index is an integer, and there is one for each dimension.",
        "a := list[1, 2];",
    ),
    FindingCode.NO_ARRAY: Explanation(
        "This is no array", "Only an ARRAY, or a reference to one, can be indexed.", "a := b[1];"
    ),
    FindingCode.NO_MEMBERS: Explanation(
        "This has no members",
        "Only a STRUCT, an instance of a function block, or a reference to one has members. An "
        "integer has bits: `a.3`, or `a.ALARM` where `ALARM` is a constant or a value of an "
        "enumeration.",
        "a := b.c;",
    ),
    FindingCode.WRONG_LABEL: Explanation(
        "The label of a CASE must be a constant",
        "A number, a constant, a value of an enumeration, or a range of them.",
        "CASE a OF b: c; END_CASE",
    ),
    FindingCode.LABEL_TWICE: Explanation(
        "A value has two labels in a CASE",
        "The first one would count, and the other never run.",
        "CASE a OF 1: b; 0..3: c; END_CASE",
    ),
    FindingCode.WRONG_BIT: Explanation(
        "There is no such bit",
        "Bits are counted from 0 up to the width of the integer, less one.",
        "a.16 := TRUE;",
    ),
    FindingCode.NO_REFERENCE: Explanation(
        "This is no reference",
        "ACCESS and REF= set a variable that is declared as REFERENCE TO; `^` follows a pointer.",
        "number ACCESS ADR(a);",
    ),
    FindingCode.NO_ADDRESS: Explanation(
        "This has no address",
        "A bit, a number or the result of a calculation lies nowhere in memory.",
        "p := ADR(a.3);",
    ),
    FindingCode.INDEX_OUTSIDE: Explanation(
        "A constant index lies outside the bounds",
        "The access would meet another variable, or none.",
        "list[11] := 0; (* ARRAY[0..9] *)",
    ),
    FindingCode.VALUE_OUTSIDE: Explanation(
        "The number does not fit",
        "No conversion keeps its value, nor its bits.",
        "small := 70000; (* INT *)",
    ),
    FindingCode.DIVISION_BY_ZERO: Explanation(
        "A constant zero divides", "The program would end in SERVICE here.", "a := b / 0;"
    ),
    FindingCode.NOT_SUPPORTED: Explanation(
        "This is Structured Text that plcsim does not run",
        "Object orientation (METHOD, PROPERTY, INTERFACE, CLASS, EXTENDS), jumps "
        "and labels, what a chart asks for and is not there. The message names it.",
        "METHOD go END_METHOD",
    ),
    FindingCode.OTHER_CASE: Explanation(
        "The name is declared in another case",
        "Automation Studio's compiler would not find it; plcsim takes the only declaration that "
        "differs in case alone.",
        "Speed := 1; (* speed : INT *)",
    ),
    FindingCode.UNUSED_VARIABLE: Explanation(
        "A variable is never used",
        "No unit of the program names it. It may still be read from outside, by a panel or a test.",
    ),
    FindingCode.UNREACHABLE: Explanation(
        "These statements are never reached", "They stand behind RETURN, EXIT or CONTINUE."
    ),
    FindingCode.COMPARED: Explanation(
        "A comparison as a statement", "`=` compares. To assign a value, write `:=`.", "a = b;"
    ),
    FindingCode.NARROWED: Explanation(
        "The value may not fit",
        "A larger type is assigned to a smaller one; its low bits are kept.",
        "small := large; (* INT := DINT *)",
    ),
    FindingCode.SIGN_MIXED: Explanation(
        "A signed and an unsigned number are compared",
        "Both are compared as unsigned numbers of 32 bits: -1 is larger than 1 then.",
        "IF dint < udint THEN",
    ),
    FindingCode.NO_EFFECT: Explanation(
        "The statement does nothing", "A value is worked out and dropped.", "a;"
    ),
    FindingCode.NEVER_CALLED: Explanation(
        "Nothing calls the action",
        "As in Automation Studio it is not compiled, and what may be wrong in it is not told.",
    ),
}
"""What the page says, for every code."""
