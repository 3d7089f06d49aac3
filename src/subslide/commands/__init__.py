"""The verbs of the command line: each module of this folder adds its own to the group `cli`.

Start-up is most of a radial run's time, so what a verb needs is imported when it is called.
"""

import os
import signal
import sys

import click

import subslide
from subslide.files import Stopped
from subslide.keys import words

MODULES = tuple(
    f"{__name__}.{name}"
    for name in (
        "solving",
        "study",
        "planning",
        "making",
        "tabulating",
        "sensitivity",
        "emulating",
        "showing",
    )
)
"""Modules with verbs, in the order that help lists them."""


class Verb(click.Command):
    """Command that takes each option once, unless it says that it takes more."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Return the words that are left over; UsageError if an option is given twice, where click takes the last."""
        given = self.make_parser(ctx).parse_args(list(args))[2]
        for option in given:
            if isinstance(option, click.Option) and not option.multiple and given.count(option) > 1:
                raise click.UsageError(f"{max(option.opts, key=len)}: given twice; allowed: each option once")
        return super().parse_args(ctx, args)


class Verbs(click.Group):
    """Group of commands that lists them in the order they were written, and names the nearest to a mistyped one."""

    command_class = Verb

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of the commands."""
        return list(self.commands)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the command that is called; UsageError, with what is allowed, if there is none."""
        if args and args[0] not in self.commands:
            known = [name for name, command in self.commands.items() if not command.hidden]
            hint = words.closest(args[0], known)
            raise click.UsageError(f"{args[0]}: there is no such command; allowed: {', '.join(known)}{hint}")
        return super().resolve_command(ctx, args)

    def invoke(self, ctx: click.Context) -> object:
        """Return what the called command returns, 0 if nobody reads on; Stopped after Ctrl-C, where click says more."""
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt:
            raise Stopped(signal.SIGINT) from None
        except BrokenPipeError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return 0


@click.group(cls=Verbs, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110})
@click.version_option(subslide.__version__, prog_name="subslide")
def cli() -> None:
    """Solve the collapse of submerged granular columns: two-layer Coulomb runs, records, tables and figures."""
