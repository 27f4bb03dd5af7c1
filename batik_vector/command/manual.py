"""``batik-vector man``: the manual page, made of the declarations that make ``--help``."""

from __future__ import annotations

import re
from collections.abc import Iterator

import click

from batik_vector._version import __version__

NAME = "batik-vector"
EXIT_CODES = (
    ("0", "done"),
    ("1", "what was looked at has faults (check, analyse, import)"),
    ("2", "the recipe or the call is wrong, or a file cannot be written"),
    ("130", "interrupted"),
)
ENVIRONMENT = (
    ("BATIK_LIBRARY", "Where library:NAME is looked up, as --library."),
    ("NO_COLOR", "Changes nothing: colours are never printed."),
)
FILES_MEAN = "A recipe is a page of TOML; what its tables take is printed by batik\\-vector schema."


def exit_codes_told(command: click.Command) -> None:
    """Let the help of a command, and of those below it, end with what it exits with."""
    command.epilog = f"Exits with {'; '.join(f'{code}: {words}' for code, words in EXIT_CODES)}."
    if isinstance(command, click.Group):
        for each in command.commands.values():
            exit_codes_told(each)


@click.command("man", short_help="Print the manual page.")
@click.pass_context
def man_command(ctx: click.Context) -> None:
    """Print the manual page of all commands.

    batik-vector man | man -l -  shows it; batik-vector man > batik-vector.1  keeps it.
    """
    click.echo(manual(ctx.find_root().command), nl=False)


def manual(command: click.Command) -> str:
    """Return the manual page of a command and of those below it, as man(7) has it."""
    lines = [
        f'.TH {_roff(NAME.upper())} 1 "" "{_roff(f"{NAME} {__version__}")}" "User Commands"',
        ".SH NAME",
        f"{_roff(NAME)} \\- compile batik patterns",
        ".SH SYNOPSIS",
        f".B {_roff(NAME)}\n[OPTIONS] COMMAND [ARGS]",
        ".SH DESCRIPTION",
    ]
    context = click.Context(command, info_name=NAME, terminal_width=10_000, max_content_width=10_000)
    lines += [*_described(command), FILES_MEAN, ".SH OPTIONS", *_options(command, context), ".SH COMMANDS"]
    for name, each, path in _below(command, context):
        lines += [f".SS {_roff(name)}", f".B {_roff(path.command_path)}", _roff(_usage(each, path)), ".PP"]
        lines += [*_described(each), *_options(each, path)]
    for title, rows in (("EXIT STATUS", EXIT_CODES), ("ENVIRONMENT", ENVIRONMENT)):
        lines += [f".SH {title}", *(row for each in rows for row in _term(*each))]
    return "\n".join(lines) + "\n"


def _below(
    command: click.Command, context: click.Context
) -> Iterator[tuple[str, click.Command, click.Context]]:
    """Yield the commands below one, by name, each with its path, those below groups behind them."""
    if not isinstance(command, click.Group):
        return
    for name in sorted(command.commands):
        each = command.commands[name]
        path = click.Context(each, parent=context, info_name=name)
        yield path.command_path.removeprefix(f"{NAME} "), each, path
        yield from _below(each, path)


def _usage(command: click.Command, context: click.Context) -> str:
    return " ".join(command.collect_usage_pieces(context))


def _described(command: click.Command) -> Iterator[str]:
    """Yield the paragraphs of a command's help."""
    text = (command.help or "").replace("\b", "").partition("\f")[0].strip()
    for number, paragraph in enumerate(re.split(r"\n\s*\n", text)):
        if number:
            yield ".PP"
        yield _roff(" ".join(paragraph.split()))
    yield ".PP"


def _options(command: click.Command, context: click.Context) -> Iterator[str]:
    """Yield the options of a command, each with its help."""
    for each in command.get_params(context):
        record = each.get_help_record(context)
        # Arguments are in the usage, and every command has --help.
        if record is not None and isinstance(each, click.Option) and each.name != "help":
            yield from _term(*record)


def _term(name: str, words: str) -> Iterator[str]:
    yield from (".TP", f"\\fB{_roff(name)}\\fR", _roff(words))


def _roff(text: str) -> str:
    """Return a text as roff reads it: no sign of its own, hyphens that may be copied."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return f"\\&{text}" if text[:1] in (".", "'") else text
