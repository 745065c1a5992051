# SPDX-License-Identifier: Apache-2.0
# Completion for fish: the program itself says what may stand next.

function __penduline_complete
    set -l words (commandline --current-process --tokenize --cut-at-cursor)
    set -l current (commandline --current-token --cut-at-cursor)
    for line in ($words[1] complete $words[2..] "$current" 2>/dev/null)
        set -l parts (string split --max 1 \t -- $line)
        if test -n "$parts[1]"
            echo $line
        else
            set -l prefix $parts[2]
            for file in (__fish_complete_path (string sub --start (math 1 + (string length -- "$prefix")) -- "$current"))
                echo "$prefix$file"
            end
        end
    end
end

complete --command penduline --no-files --arguments '(__penduline_complete)'
