#!/usr/bin/env python3
"""Makes the man page and the completions of bash and zsh out of the program's own help texts.

    manual.py PROGRAM FOLDER    writes trivalent.1, trivalent.bash, _trivalent into the folder
"""

from __future__ import annotations

import pathlib
import re
import subprocess
import sys


def output_of(*words: str) -> str:
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


def commands_in(help_text: str) -> dict[str, str]:
    """Names and meanings of the commands."""
    return dict(re.findall(r"^  trivalent ([a-z-]+).*\n +(.*)$", help_text, flags=re.MULTILINE))


def options_in(help_text: str) -> list[str]:
    return sorted(set(re.findall(r"^  (?:-[a-z] \[ )?(--[a-z-]+)", help_text, flags=re.MULTILINE)))


def choices_in(help_text: str) -> dict[str, list[str]]:
    """Values that an option's help lists, as in "(=safe)": only the words that stand before a colon."""
    choices = {}
    for name, text in re.findall(r"^  (--[a-z-]+) arg(.*(?:\n {20,}.*)*)", help_text, flags=re.MULTILINE):
        flat = " ".join(text.split())
        words = re.findall(r"(?:^|[;.,] ?|\) )([a-z0-9-]+): ", flat)
        if len(words) > 1:
            choices[name] = words
    return choices


def roff(text: str) -> str:
    escaped = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join("\\&" + line if line.startswith((".", "'")) else line for line in escaped.splitlines())


def man_page(version: str, general: str, helps: dict[str, str]) -> str:
    page = [f'.TH TRIVALENT 1 "" "{version}" "User Commands"', ".SH NAME"]
    page += ["trivalent \\- turns any surface into sp2 carbon", ".SH SYNOPSIS", ".B trivalent", "COMMAND ..."]
    page += [".SH DESCRIPTION", ".nf", roff(general), ".fi"]
    for name, text in helps.items():
        page += [f".SH {roff(name.upper())}", ".nf", roff(text), ".fi"]
    return "\n".join(page) + "\n"


def bash_completion(helps: dict[str, str]) -> str:
    lines = ["# bash completion for trivalent", "_trivalent() {", "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}"]
    lines += ["  if [[ $COMP_CWORD -eq 1 ]]; then", f"    COMPREPLY=($(compgen -W '{' '.join(helps)} --help --version' -- \"$current\"))", "    return", "  fi"]
    lines += ["  case ${COMP_WORDS[1]}:$before in"]
    for name, text in helps.items():
        for option, words in choices_in(text).items():
            lines.append(f"    {name}:{option}) COMPREPLY=($(compgen -W '{' '.join(words)}' -- \"$current\")); return ;;")
    lines += ["  esac", "  [[ $current == -* ]] || return", "  case ${COMP_WORDS[1]} in"]
    for name, text in helps.items():
        lines.append(f"    {name}) COMPREPLY=($(compgen -W '{' '.join(options_in(text))}' -- \"$current\")) ;;")
    lines += ["  esac", "}", "complete -o default -F _trivalent trivalent", ""]
    return "\n".join(lines)


def zsh_completion(commands: dict[str, str], helps: dict[str, str]) -> str:
    lines = ["#compdef trivalent", "_trivalent() {", "  if (( CURRENT == 2 )); then", "    local -a commands=("]
    for name in helps:
        meaning = commands[name].replace("'", "").replace(":", ",")
        lines.append(f"      '{name}:{meaning}'")
    lines += ["    )", "    _describe command commands", "    return", "  fi", "  case $words[2]:$words[CURRENT-1] in"]
    for name, text in helps.items():
        for option, words in choices_in(text).items():
            lines.append(f"    {name}:{option}) compadd {' '.join(words)}; return ;;")
    lines += ["  esac", "  if [[ $PREFIX != -* ]]; then _files; return; fi", "  case $words[2] in"]
    for name, text in helps.items():
        lines.append(f"    {name}) compadd -- {' '.join(options_in(text))} ;;")
    lines += ["  esac", "}", '_trivalent "$@"', ""]
    return "\n".join(lines)


def main() -> None:
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    general = output_of(program, "--help")
    commands = commands_in(general)
    helps = {name: output_of(program, name, "--help") for name in commands}
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "trivalent.1").write_text(man_page(output_of(program, "--version").strip(), general, helps))
    (folder / "trivalent.bash").write_text(bash_completion(helps))
    (folder / "_trivalent").write_text(zsh_completion(commands, helps))


if __name__ == "__main__":
    main()
