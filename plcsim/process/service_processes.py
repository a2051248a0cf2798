"""The services beside a scan: started when the image is laid out, started again when they end."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
from typing import TYPE_CHECKING

from plcsim.core.backoff import Backoff
from plcsim.host.signals import held_back
from plcsim.process.service_main import HELD_BACK, ServiceOrder
from plcsim.project.extension import extensions, services_of
from plcsim.shared_image import ImageNotReady, ImageReader
from plcsim.shared_image.guest import tidy
from plcsim.shared_image.layout import HEADER_SIZE, make_file
from plcsim.shared_image.status_page import ServiceState

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping
    from typing import Any

    from plcsim.process.output import ChildOutput, Output
    from plcsim.shared_image.status_page import StatusPage

MAIN = "plcsim.process.service_main"

FIRST_PAUSE_NS = 100_000_000
"""Between the end of a service and its next start."""

LONGEST_PAUSE_NS = 10_000_000_000
"""The pause doubles up to here for a service that gives up by itself, with exit code 1."""

TIDY_NS = 1_000_000_000
"""Between two looks at what guests that have died have left."""


class _Service:
    """One service process and when to start it again."""

    def __init__(
        self,
        module: str,
        order: ServiceOrder,
        page: StatusPage,
        output: ChildOutput,
        stopping_s: float,
    ) -> None:
        self.order = order
        self._stopping_s = stopping_s
        self._module = module
        self._page = page
        self._output = output
        self.starts = 0
        self._process: subprocess.Popen[bytes] | None = None
        self._backoff = Backoff(FIRST_PAUSE_NS, LONGEST_PAUSE_NS)

    def tend(self, now_ns: int) -> None:
        """Start the process, where it is not running and its pause is over."""
        if self._process is not None:
            if self._process.poll() is None:
                return
            gave_up = self._process.returncode == 1
            self._process = None
            self._page.note_service(self.order.number, ServiceState.FAILING)
            if not gave_up:
                self._backoff.succeeded()
            self._backoff.failed(now_ns)
        if self._backoff.is_due(now_ns):
            self._start()

    def _start(self) -> None:
        order = self.order
        with held_back(HELD_BACK):
            self._process = subprocess.Popen(  # noqa: S603  # a module that an extension named
                [sys.executable, "-P", "-m", MAIN, self._module, order.to_json()],
                pass_fds=(order.image_fd, order.status_fd, order.wake_fd),
                process_group=0,
                stdin=subprocess.DEVNULL,
                stdout=self._output.fds[0],
                stderr=self._output.fds[1],
            )
        self.starts += 1

    @property
    def state(self) -> ServiceState:
        """How it does."""
        return self._page.service_state(self.order.number)

    @property
    def never_served(self) -> bool:
        """It had its chance: it ended by itself or said why it could not."""
        failing = self.state is ServiceState.FAILING
        return failing and not self._page.has_served(self.order.number)

    @property
    def pid(self) -> int | None:
        """The process, None before its first start."""
        return None if self._process is None else self._process.pid

    def stop(self) -> None:
        """Ask the process to end; kill it where it does not."""
        if self._process is None:
            return
        self._process.terminate()
        try:
            self._process.wait(self._stopping_s)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()


class ServiceProcesses:
    """The services of a project.

    Args:
        settings: of the extensions of the project, by table.
        page: the status page.
        output: carries what the services print.
        quiet: the services print nothing but errors.
        only: tables whose services run, None for all.

    Attributes:
        image_fd: the shared image, for the scan process to lay out.
        wake_fds: an eventfd for each service, in the order of the tables.
    """

    def __init__(
        self,
        settings: Mapping[str, Any],
        page: StatusPage,
        output: Output,
        *,
        quiet: bool = False,
        only: Collection[str] | None = None,
    ) -> None:
        self.image_fd = make_file()
        self._is_laid_out = self._is_closed = False
        self._image: ImageReader | None = None
        self._tidy_ns = 0
        modules = services_of(settings)
        self.wake_fds = [os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC) for _ in modules]
        self._services = [
            _Service(
                module,
                ServiceOrder(name, number, os.getpid(), self.image_fd, page.fd, wake_fd, quiet),
                page,
                output.child(),
                extensions()[name].stopping_s(settings[name]),
            )
            for number, ((name, module), wake_fd) in enumerate(
                zip(modules.items(), self.wake_fds, strict=True)
            )
            if only is None or name in only
        ]

    def tend(self, now_ns: int) -> None:
        """Start what is not running, once the scan process has laid the image out."""
        if not self._is_laid_out_now():
            return
        for service in self._services:
            service.tend(now_ns)
        if now_ns >= self._tidy_ns:
            self._tidy_ns = now_ns + TIDY_NS
            if self.image is not None:
                tidy(self.image, self.image_fd)

    def _is_laid_out_now(self) -> bool:
        if not self._is_laid_out:
            self._is_laid_out = os.fstat(self.image_fd).st_size > HEADER_SIZE
        return self._is_laid_out

    @property
    def image(self) -> ImageReader | None:
        """The shared image, None until the scan process has laid it out."""
        if self._image is None:
            with contextlib.suppress(ImageNotReady):
                self._image = ImageReader(self.image_fd)
        return self._image

    @property
    def pids(self) -> set[int]:
        """The processes that run, as far as is known."""
        return {service.pid for service in self._services if service.pid is not None}

    @property
    def starts(self) -> dict[str, int]:
        """How often each service was started, by table."""
        return {service.order.table: service.starts for service in self._services}

    @property
    def states(self) -> dict[str, ServiceState]:
        """How each service does, by table."""
        return {service.order.table: service.state for service in self._services}

    @property
    def never_served(self) -> list[str]:
        """Tables of the services that could not serve at any time of the run."""
        return [service.order.table for service in self._services if service.never_served]

    def close(self) -> None:
        """End all services and give the descriptors back.

        One that was never started, in a very short run, is started: a recorder has work to do.
        """
        if self._is_closed:
            return
        self._is_closed = True
        for service in self._services:
            if not service.starts and self._is_laid_out_now():
                service.tend(0)
        for service in self._services:
            service.stop()
        for fd in (self.image_fd, *self.wake_fds):
            os.close(fd)
