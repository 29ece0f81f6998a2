#!/usr/bin/env bash
# Every command of the table: its help ends with 0 and starts nothing, a mistyped option with 2, and the completion is a script
# that bash takes. And where an installed program finds what belongs to it.
#   every_command.sh PROSPECT
set -uo pipefail
prospect=$1
faults=0
fault() { echo "FAULT $*"; faults=$((faults + 1)); }

commands=$("$prospect" --help | sed -n 's/^  \([a-z-]*\( [a-z-]*\)\?\)  .*/\1/p')
[ "$(wc -l <<<"$commands")" -ge 30 ] || fault "few commands: $commands"
while read -r command; do
  # Not piped: grep -q ends at the first match, and who then still writes is killed.
  grep -q "^usage: ./prospect $command" <<<"$("$prospect" $command --help)" || fault "$command --help"
  said=$("$prospect" --dry-run $command --nonsense 2>&1)
  [ $? = 2 ] && grep -q "unknown option '--nonsense'" <<<"$said" || fault "$command --nonsense: $said"
  [ "$(wc -l <<<"$said")" = 1 ] || fault "$command --nonsense says more than a line: $said"
done <<<"$commands"
"$prospect" completion bash | bash -n || fault 'the completion is no script'
bash -c 'source <("$0" completion bash); COMP_WORDS=(prospect ru) COMP_CWORD=1; _prospect; [ "${COMPREPLY[0]}" = run ]' "$prospect" ||
  fault '"ru" is not completed'
bash -c 'source <("$0" completion bash); COMP_WORDS=(prospect run --no-r) COMP_CWORD=2; _prospect; [ "${COMPREPLY[0]}" = --no-reset ]' \
  "$prospect" || fault '"run --no-r" is not completed'
"$prospect" nonsense 2>/dev/null
[ $? = 2 ] || fault 'an unknown command'
grep -q 'did you mean oracle' <<<"$("$prospect" oracel 2>&1)" || fault 'oracel'
[ "$("$prospect" --programs demo | wc -l)" -ge 6 ] || fault '--programs demo'
[ -z "$("$prospect" --programs demo --help)" ] || fault '--programs demo --help'

# Installed: programs in lib/prospect, data in share/prospect, and no "./" before its name.
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
mkdir -p "$place"/{bin,lib/prospect,share/prospect}
cp "$prospect" "$place/bin"
cp -r "$(dirname "$0")/../../../tasks" "$place/share/prospect"
printf '#!/bin/sh\necho key=/there\n' >"$place/lib/prospect/prospect-supervisor"
chmod +x "$place/lib/prospect/prospect-supervisor"
grep -q '^usage: prospect run' <<<"$("$place/bin/prospect" run --help)" || fault 'the usage of an installed one'
[ "$("$place/bin/prospect" key)" = /there ] || fault 'programs of an installed one are not found'
said=$("$place/bin/prospect" up --task navigation 2>&1)
[ $? = 10 ] && grep -q "$place/share/prospect/model/weights/navigation.safetensors" <<<"$said" || fault "data of an installed one: $said"

[ "$faults" = 0 ]
