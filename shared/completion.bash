# Completion of Spall's command lines in bash: options, keys of the inputs, files. Use it with: source shared/completion.bash
# What can be completed comes from the --help of each program, so that this file knows no option and no key.

declare -gA _spall_help=() # of the commands that have been completed: starting a program takes a third of a second

# Prints the --help of a command.
_spall_help_of() {
  local command="$*"
  [[ -v _spall_help[$command] ]] || _spall_help[$command]=$("$@" --help 2>/dev/null </dev/null)
  printf '%s\n' "${_spall_help[$command]}"
}

# Puts the words of standard input that begin with the one at the cursor into COMPREPLY, as one would type them. $1: what
# stands behind each.
_spall_offer() {
  local word=${COMP_WORDS[COMP_CWORD]} line quoted
  while IFS= read -r line; do
    printf -v quoted %q "$line"
    if [[ $quoted == "$word"* ]]; then COMPREPLY+=("$quoted$1"); fi
  done
}

# Keys as one writes them on a command line: a body's own name may be left out, as in AFC/C1.
_spall_keys() { sed -nE 's/^  (NAME\/)?([A-Z][^ ].*\/.*)$/\2/p' | sort -u; }

_spall_complete() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=("$1")
  COMPREPLY=()
  if [[ ${1##*/} == spall ]]; then
    if ((COMP_CWORD == 1)); then
      _spall_offer " " < <("$1" help | sed -nE 's/^  ([a-z_ |]+)  .*/\1/p' | tr -d ' ' | tr '|' '\n')
      return
    fi
    command+=("${COMP_WORDS[1]}")
    [[ ${COMP_WORDS[1]} == @(run|data|help) ]] && return
  elif [[ ${1##*/} == @(study|formulas|concrete|tension|view) && $1 != *shared/* ]]; then
    return # a program of that name that is not ours
  fi
  if [[ $word == -* ]]; then
    _spall_offer " " < <(_spall_help_of "${command[@]}" | grep -oE -- '--[a-z][a-z-]*' | sort -u)
  elif [[ $before == --help || $before == -h ]]; then
    _spall_offer " " < <(_spall_help_of "${command[@]}" | _spall_keys)
  elif [[ $before != -* && $word == [A-Z]* ]]; then
    _spall_offer "=" < <(_spall_help_of "${command[@]}" | _spall_keys)
  fi
}

# Where nothing is found bash completes names of files.
complete -o default -o nospace -F _spall_complete \
  penetrate microcell material_point spall study formulas concrete tension view compare.py
