# SPDX-License-Identifier: Apache-2.0
# Completion for bash, by bash-completion: the program itself says what may stand next.
# shellcheck shell=bash

_penduline() {
  local cur words cword word help prefix file
  _get_comp_words_by_ref -n := cur words cword
  COMPREPLY=()
  while IFS= read -r word; do
    help=${word#*$'\t'} word=${word%%$'\t'*}
    if [ -n "$word" ]; then
      COMPREPLY+=("$word")
    elif [[ $cur != "$help"* ]]; then
      COMPREPLY+=("$help")
    else
      prefix=$help
      compopt -o filenames
      while IFS= read -r file; do
        COMPREPLY+=("$prefix$file")
      done < <(compgen -f -- "${cur#"$prefix"}")
    fi
  done < <("${words[0]}" complete "${words[@]:1:cword}" 2>/dev/null)
  case ${COMPREPLY[*]} in
    *[:/=]) compopt -o nospace ;;
  esac
  # What stands before a colon or an equals sign is another word to bash.
  prefix=${cur%"${cur##*[:=]}"}
  COMPREPLY=("${COMPREPLY[@]#"$prefix"}")
}
complete -F _penduline penduline
