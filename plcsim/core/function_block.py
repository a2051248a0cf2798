"""Function blocks: a data block in PLC memory and one method that runs on it.

A block is declared as a variable and called once a cycle::

    class Main(Program):
        timer = var(TON)

        def cyclic(self) -> None:
            self.timer(IN=self.start, PT=500)
            if self.timer.Q: ...

All that a block remembers lies in its data block, so Structured Text, C and Python see one state;
only what cannot lie in memory (a socket) is kept in the context, under a number in the data block.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from st_types.types.views import DataBlock, context_of, refused

if TYPE_CHECKING:
    from plcsim.core.context import Context


class FunctionBlock(DataBlock):
    """Base of all function blocks in Python.

    A subclass declares its inputs, outputs and internals with `var_input`, `var_output` and `var`,
    and implements `execute`.
    """

    __slots__ = ()

    def execute(self) -> None:
        """Run the block once on its data block.

        A body in Python is this method; without it the one that the block's library has in another
        language runs.

        Raises:
            NotImplementedError: nothing knows of another one.
        """
        self.context.run_block(self)

    def __call__(self, **inputs: object) -> None:
        """Assign ``inputs`` by name, then run the block once.

        Raises:
            ValueRangeError: one cannot take its value.
        """
        for name, value in inputs.items():
            try:
                setattr(self, name, value)
            except TypeError:
                raise refused(self, name, value) from None
        self.execute()

    @property
    def context(self) -> Context:
        """The controller the block lies in.

        Raises:
            RuntimeError: the block was made outside a controller.
        """
        context: Context | None = context_of(self)
        if context is None:
            raise RuntimeError(f"{type(self).__name__} runs only inside a controller.")
        return context
