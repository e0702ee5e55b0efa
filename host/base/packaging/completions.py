# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the completions of the shells from `--help`: commands, options, and what may follow them.

completions.py TACTUS TACTUS_HOST FOLDER

Which names a graph has is not known when this runs, so the completions call names_in_graph.py for them.
"""
import pathlib
import sys

import program_help

# What the value of an option is, and what a positional argument is. `file` is any file, `graph` a graph file or a preset; the
# others are kinds of names_in_graph.py. The values of other options can be completed only if --help lists them.
VALUES = {"--record": "ports", "--input": "ports", "--over": "ports", "--port": "ports", "--trigger": "ports", "--route": "ports", "--set": "sets", "--device": "roles",
          "--bind": "roles", "--feed": "file", "--out": "file", "--plot": "file", "--log": "file", "--replay": "file",
          "--capture": "file", "--calibration": "file", "--session": "file", "--file": "file", "--places": "file", "--plugins": "file", "--live": "file",
          "--clip": "file", "--gesture": "file", "--test": "file", "--role": "roles", "--graph": "graph", "log": "file", "in": "file", "graph": "graph", "graphs": "graph", "files": "file", "type": "nodes", "values": "sets", "hits": "hits", "port": "ports"}

BASH = r'''# bash completion for tactus and tactus-host. Written by completions.py from --help.

_tactus_names ()
{
    local program
    program=$(readlink -f "$(command -v tactus)") || return
    python3 "${program%/bin/*}/share/tactus/names_in_graph.py" "$program" "$@" 2>/dev/null
}

# _tactus_reply NAME…: offers the names that begin with the current word. Readline takes = and : for the ends of words.
_tactus_reply ()
{
    local name lead=${cur%"${cur##*[=:]}"}
    for name; do
        [[ $name == "$cur"* ]] && COMPREPLY+=("${name#"$lead"}")
    done
    [[ ${COMPREPLY-} == *= ]] && compopt -o nospace
}

_tactus_value ()
{
    local names listed
    case $1 in
        '') ;;
        file) _filedir ;;
        graph) mapfile -t names < <(_tactus_names presets); _tactus_reply "${names[@]}"; _filedir json ;;
        "{"*) IFS=, read -ra names <<<"${1//[\{\}]/}"; _tactus_reply "${names[@]}" ;;
        *)
            mapfile -t names < <(_tactus_names "$1" "${words[@]:2}")
            listed=
            [[ $1 == ports && $cur == *,* ]] && listed=${cur%,*},
            _tactus_reply "${names[@]/#/$listed}" ;;
    esac
}

_tactus ()
{
    local cur prev words cword
    _get_comp_words_by_ref -n =: cur prev words cword
    local program=${words[0]##*/} command='' options value
    if [[ $program == tactus ]]; then
        if ((cword == 1)); then
            mapfile -t COMPREPLY < <(compgen -W '@COMMANDS@ --help --version' -- "$cur")
            return
        fi
        command=${words[1]}
    fi
    case "$program $command" in
@CASES@
        *) return ;;
    esac
    if [[ $cur == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$options" -- "$cur")
    else
        _tactus_value "$value"
    fi
}

complete -F _tactus tactus tactus-host
'''

ZSH = r'''#compdef tactus tactus-host
# zsh completion for tactus and tactus-host. Written by completions.py from --help.

# _tactus_names KIND: offers names; those that end with = stay open for the value.
_tactus_names ()
{
    local program=${commands[tactus]:A}
    local -a names
    names=(${(f)"$(python3 ${program:h:h}/share/tactus/names_in_graph.py $program $1 ${(Q)words} 2>/dev/null)"})
    if [[ $1 == ports ]]; then
        compset -P '*,'
    fi
    compadd -S '' -a names
}

_tactus_graphs ()
{
    _tactus_names presets
    _files -g '*.json'
}

_tactus ()
{
    local context state state_descr line
    typeset -A opt_args
    if [[ $service == tactus-host ]]; then
        _arguments @HOST@
        return
    fi
    local -a commands_of_tactus=(
@COMMANDS@
    )
    _arguments -C '(- *)--help[print help]' '(- *)--version[print the version]' '1:command:->command' '*::argument:->argument'
    case $state in
        command) _describe command commands_of_tactus ;;
        argument)
            case $words[1] in
@CASES@
            esac ;;
    esac
}

_tactus "$@"
'''

FISH = r'''# fish completion for tactus. Written by completions.py from --help.

function __tactus_names
    set -l program (realpath (command -v tactus))
    python3 (string replace -r '/bin/[^/]*$' '' $program)/share/tactus/names_in_graph.py $program $argv[1] (commandline -opc)[3..-1] 2>/dev/null
end

# Names of ports in a list, such as a.force,b.state
function __tactus_listed
    set -l before (string match -r '.*,' -- (commandline -ct))
    __tactus_names ports | string replace -r '^' -- "$before"
end

'''


def short(about):
    """The first clause of a description."""
    for end in (";", ":", ", such as", " ("):
        about = about.split(end)[0]
    return about.strip().rstrip(".")


def value_of(item):
    return "{" + ",".join(item.alternatives) + "}" if item.alternatives else VALUES.get(item.names[-1], "")


def bash(pages):
    cases = []
    for page in pages:
        program, _, command = page.name.partition(" ")
        if program == "tactus" and not command:
            continue
        values = [f"                {'|'.join(o.names)}) _tactus_value '{value_of(o)}'; return ;;" for o in page.options if o.takes_value]
        names = " ".join(name for option in page.options for name in option.names)
        positional = value_of(page.positionals[0]) if page.positionals else ""
        cases += [f"        '{program} {command}')", f"            options='{names}' value='{positional}'"]
        if values:
            cases += ["            case $prev in", *values, "            esac"]
        cases[-1] += " ;;"
    commands = " ".join(item.term for item in pages[0].commands)
    return BASH.replace("@COMMANDS@", commands).replace("@CASES@", "\n".join(cases))


def zsh_action(item):
    value = value_of(item)
    if value.startswith("{"):
        return "(" + " ".join(item.alternatives) + ")"
    # _arguments adds its own arguments to an action, unless the action begins with a space.
    return {"": " ", "file": "_files", "graph": " _tactus_graphs"}.get(value, f" _tactus_names {value}")


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def zsh_arguments(page):
    specs = []
    for option in page.options:
        about = short(option.about).replace("[", "(").replace("]", ")").replace(":", "\\:")
        repeats = "*" if "..." in option.term else ""
        for name in option.names:
            specs.append(quoted(f"{repeats}{name}[{about}]" + (f":value:{zsh_action(option)}" if option.takes_value else "")))
    for item in page.positionals:
        many = "*" if "..." in item.term else ""
        specs.append(quoted(f"{many}:{item.names[0]}:{zsh_action(item)}"))
    return " ".join(specs)


def zsh(pages, host):
    cases = [f"                {page.name.split()[1]}) _arguments {zsh_arguments(page)} ;;" for page in pages[1:]]
    commands = [f"        {quoted(item.term + ':' + short(item.about).replace(':', chr(92) + ':'))}" for item in pages[0].commands]
    return ZSH.replace("@HOST@", zsh_arguments(host)).replace("@COMMANDS@", "\n".join(commands)).replace("@CASES@", "\n".join(cases))


def fish_values(item):
    value = value_of(item)
    if value.startswith("{"):
        return f"-x -a '{' '.join(item.alternatives)}'"
    if value == "ports" and item.names[0].startswith("-"):
        return "-x -a '(__tactus_listed)'"
    return {"": "-x", "file": "-r -F", "graph": "-F -a '(__tactus_names presets)'"}.get(value, f"-x -a '(__tactus_names {value})'")


def fish_lines(page, where):
    for option in page.options:
        flags = " ".join(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}" for name in option.names)
        values = " " + fish_values(option) if option.takes_value else ""
        yield f"{where} {flags}{values} -d {quoted(short(option.about))}"
    for item in page.positionals:
        yield f"{where} {fish_values(item).replace('-x ', '')}"


def fish(pages):
    lines = ["complete -c tactus -f", "complete -c tactus -n __fish_use_subcommand -l help -d 'Print help'",
             "complete -c tactus -n __fish_use_subcommand -l version -d 'Print the version'"]
    lines += [f"complete -c tactus -n __fish_use_subcommand -a {item.term} -d {quoted(short(item.about))}" for item in pages[0].commands]
    for page in pages[1:]:
        lines += fish_lines(page, f"complete -c tactus -n '__fish_seen_subcommand_from {page.name.split()[1]}'")
    return FISH + "\n".join(lines) + "\n"


def main(tactus, tactus_host, folder):
    pages = program_help.read_all(tactus, "tactus")
    host = program_help.read(tactus_host, "tactus-host")
    folder = pathlib.Path(folder)
    in_bash = bash([*pages, host])
    in_fish = "\n".join(fish_lines(host, "complete -c tactus-host")) + "\n"
    # bash and fish look for a file with the name of the program.
    for name, text in (("bash/tactus", in_bash), ("bash/tactus-host", in_bash), ("zsh/_tactus", zsh(pages, host)),
                       ("fish/tactus.fish", fish(pages)), ("fish/tactus-host.fish", in_fish)):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")


main(*sys.argv[1:])
