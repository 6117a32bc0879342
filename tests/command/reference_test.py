#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Shell completion and man pages: they agree with --help, and shells and man accept them."""

import re
import shutil
import subprocess

from common import Skip, case, check, check_equal, check_in, main, run

# Completion in bash as by pressing Tab after these words, with the real `complete` and `compgen`.
TAB = r"""
source "$1"; shift
[[ "$(complete -p tagfield)" == 'complete -F _tagfield tagfield' ]] || exit 1
COMP_WORDS=(tagfield "$@"); COMP_CWORD=$#; COMP_LINE="${COMP_WORDS[*]}"; COMP_POINT=${#COMP_LINE}
_tagfield tagfield "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD-1]}"
printf '%s\n' "${COMPREPLY[@]}"
"""


def commands(context):
    """Names of all commands in --help."""
    section = context.run_well("--help").out.split("Subcommands:\n")[1].split("\n\n")[0]
    return re.findall(r"^  (\w+) ", section, re.MULTILINE)


def options(context, command):
    """Long names of a command's options in its --help."""
    text = context.run_well(command, "--help").out
    return set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", text, re.MULTILINE))


def script(context, shell):
    path = context.folder / f"completion.{shell}"
    if path.exists():
        return path
    return context.write(f"completion.{shell}", context.run_well("completion", shell).out)


def tab(context, *words):
    """Completions by bash for the last of the words."""
    result = run(["bash", "--norc", "-c", TAB, "bash", script(context, "bash"), *words], cwd=context.folder)
    check_equal(result.code, 0, f"exit code of completing {words} ({result.err!r})")
    return set(result.out.split("\n")) - {""}


@case
def bash_completes_commands_and_options(context):
    names = commands(context)
    check(len(names) > 15, f"commands are {names}")
    check_equal(tab(context, ""), {*names, "-h", "--help", "--version", "--json"}, "what Tab offers")
    check_equal(tab(context, "ca"), {"calibrate"}, "ca Tab")
    for name in ("localize", "serve"):
        check_equal({word for word in tab(context, name, "-") if word.startswith("--")},
                    options(context, name), f"options of {name}")
    check_equal(tab(context, "run", "--re"), {"--record-only", "--resume"}, "run --re Tab")
    check_equal(tab(context, "man", "tr"), {"track"}, "man tr Tab")
    check_equal(tab(context, "completion", ""), {"bash", "zsh", "fish"}, "completion Tab")


@case
def bash_completes_values(context):
    for name in ("hall.yaml", "hall two.yml", "reads.csv", "notes.txt"):
        context.write(name, "")
    (context.folder / "results").mkdir()
    check_equal(tab(context, "run", ""), {"hall.yaml", "hall two.yml", "results"}, "run Tab")
    check_equal(tab(context, "run", "--seed", "3", "ha"), {"hall.yaml", "hall two.yml"}, "after a value")
    check_equal(tab(context, "localize", "--poses", ""), {"reads.csv", "results"}, "--poses Tab")
    check_equal(tab(context, "localize", "--vertical-side", ""), {"above", "below"}, "--vertical-side Tab")
    check_equal(tab(context, "localize", "--vertical-side", "a"), {"above"}, "--vertical-side a Tab")
    check_equal(tab(context, "run", "--seed", ""), set(), "a number has no completion")
    check("notes.txt" in tab(context, "run", "--out", ""), "--out Tab lacks notes.txt")


@case
def zsh_and_fish_take_their_scripts(context):
    skipped = []
    for shell, syntax in (("zsh", ["zsh", "-n"]), ("fish", ["fish", "--no-execute"])):
        path = script(context, shell)
        text = path.read_text(encoding="utf-8")
        for name in commands(context):
            check_in(name, text, f"completion of {shell}")
        if shutil.which(shell):
            result = run([*syntax, path], cwd=context.folder)
            check_equal((result.code, result.err), (0, ""), f"what {shell} says of it")
        else:
            skipped.append(shell)
    if shutil.which("fish"):
        found = run(["fish", "--no-config", "-c", f"source {script(context, 'fish')}; complete -C 'tagfield localize --vertical-side '"],
                    cwd=context.folder)
        check_equal({line.split("\t")[0] for line in found.out.splitlines()}, {"above", "below"}, "what fish offers")
    if skipped:
        raise Skip(f"{' and '.join(skipped)} are not installed; their scripts were made and not tried")


@case
def man_pages_have_what_help_has(context):
    context.run_well("man", "--out", context.folder)
    names = commands(context)
    pages = {path.name: path for path in context.folder.glob("*.1")}
    check_equal(set(pages), {"tagfield.1", *(f"tagfield-{name}.1" for name in names)}, "pages")
    for name in ("run", "localize", "new", "doctor"):
        text = pages[f"tagfield-{name}.1"].read_text(encoding="utf-8").replace("\\-", "-")
        for option in options(context, name):
            check_in(f"\\fB{option}\\fR", text, f"page of {name}")
    check_equal(context.run_well("man", "run").out, pages["tagfield-run.1"].read_text(encoding="utf-8"), "what man prints")
    result = context.run("man", "rum")
    check_equal((result.code, result.err), (2, "tagfield: man: there is no command 'rum' (did you mean 'run'?)\n"),
                "man rum")


@case
def man_and_mandoc_take_the_pages(context):
    if not shutil.which("man") and not shutil.which("mandoc"):
        raise Skip("neither man nor mandoc is installed")
    context.run_well("man", "--out", context.folder)
    pages = sorted(context.folder.glob("*.1"))
    if shutil.which("mandoc"):
        result = run(["mandoc", "-Tlint", "-Wwarning", *pages], cwd=context.folder)
        check_equal((result.code, result.out), (0, ""), "what mandoc says of the pages")
    if shutil.which("man"):
        page = context.folder / "tagfield-localize.1"
        done = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", page], check=False,
                              capture_output=True, env={"MANWIDTH": "80", "PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8"})
        check_equal((done.returncode, done.stderr), (0, b""), "what man says of a page")


if __name__ == "__main__":
    main()
