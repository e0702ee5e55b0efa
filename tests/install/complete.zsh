# SPDX-License-Identifier: MIT
# Prints what zsh offers for a command line: complete.zsh "tactus ren". Completion needs a terminal, so a second zsh runs in one,
# with a key that prints every name that a completion adds.
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell "
PROMPT=
autoload -Uz compinit
compinit -u -D
compadd ()
{
    if [[ \$@[1,(i)(-|--)] != *-[OAD]* ]]; then
        local -a added
        builtin compadd -O added \"\$@\"
        print -rl -- OFFER\$^added
    fi
    builtin compadd \"\$@\"
}
print_completions () { _main_complete; print; print -r -- E\ND; exit }
zle -C print_completions list-choices print_completions
bindkey '^T' print_completions
print REA\DY"
zpty -r shell started '*READY*'
zpty -n -w shell "$1"$'\x14'
while zpty -r shell line; do
    line=${line//$'\r'/}
    line=${line//$'\n'/}
    [[ $line == *OFFER* ]] && print -r -- "${line##*OFFER}"
    [[ $line == END ]] && break
done
zpty -d shell
