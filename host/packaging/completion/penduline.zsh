#compdef penduline
# SPDX-License-Identifier: Apache-2.0
# Completion for zsh: the program itself says what may stand next.

local line word help
local -a whole open
local -i found=1
for line in "${(@f)$(${words[1]} complete "${(@)words[2,CURRENT]}" 2>/dev/null)}"; do
  word=${line%%$'\t'*} help=${line#*$'\t'}
  if [[ -z $word ]]; then
    if [[ -z $help ]]; then
      _files && found=0
    elif compset -P "$help"; then
      _files && found=0
    else
      open+=("${help//:/\\:}")
    fi
  elif [[ $word == *[:/=] ]]; then
    open+=("${word//:/\\:}:$help")
  else
    whole+=("${word//:/\\:}:$help")
  fi
done
(( $#whole )) && _describe penduline whole && found=0
(( $#open )) && _describe penduline open -S '' && found=0
return found
