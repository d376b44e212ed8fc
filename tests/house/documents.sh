#!/usr/bin/env bash
# README, manual, glossary, headers and sources agree: links lead somewhere, names of the API and the commands exist, examples have
# the stated number of lines, each figure names the command that measures it, and files are short.
#   documents.sh SOURCE FROND COMPILER    FROND: the command; COMPILER: preprocesses C
set -euo pipefail
cd "$1"
frond=$2 compiler=$3
pages=(README.md plugin/manual/*.md)
errors=0
fail() { printf '%s\n' "$*" >&2; errors=$((errors + 1)); }

[ "$(wc -l <README.md)" -le 150 ] || fail "README.md has more than 150 lines"
[ ${#pages[@]} -ge 15 ] || fail "plugin/manual has only $((${#pages[@]} - 1)) pages"

# Links to files of the tree.
for page in "${pages[@]}"; do
    while IFS= read -r target; do
        [ -e "$(dirname "$page")/$target" ] || fail "$page: there is no $target"
    done < <(grep -oP '\]\(\K(?!http)[^)#]+' "$page")
done
for page in plugin/manual/*.md; do
    grep -qF "($page)" README.md || fail "README.md does not link $page"
done

# Decisions are few, and name files that exist.
[ "$(wc -l <plugin/DESIGN.md)" -le 250 ] || fail "plugin/DESIGN.md has more than 250 lines"
for name in $(grep -ohE '`[a-z_/0-9]+\.(cpp|hpp|md|cmake|sh)`' plugin/DESIGN.md plugin/GLOSSARY.md plugin/src/*/README.md | tr -d '`' | sort -u); do
    [ -n "$(find ./plugin/src ./tests ./tools -path "*/$name" -print -quit)" ] || fail "plugin/DESIGN.md, GLOSSARY.md or a README.md of plugin/src: there is no $name"
done

# The map of the house is short, has all rooms in the order in which they may include each other, and names files that exist.
map=plugin/src/README.md
[ "$(wc -l <$map)" -lt 80 ] || fail "$map has 80 lines or more"
rooms=$(sed -nE 's#^set\(FROND_FOLDERS (core .*)\)#\1 world contact step api#p' plugin/CMakeLists.txt)
[ "$(grep -oP '^\| `\K[a-z]+(?=` \|)' $map | tr '\n' ' ')" = "$rooms " ] || fail "$map does not list the rooms in their order: $rooms"
for name in $(grep -oE '`[a-z_]+/[a-z_/0-9]+(\.[a-z]+)?`' $map | tr -d '`' | sort -u); do
    [ -e "plugin/src/$name" ] || [ -e "$name" ] || fail "$map: there is no $name"
done
while IFS= read -r target; do
    [ -e "plugin/src/$target" ] || fail "$map: there is no $target"
done < <(grep -oP '\]\(\K(?!http)[^)#]+' $map)

# Files of the plugin are read at one sitting.
while read -r lines file; do
    [ "$lines" -le 350 ] || fail "$file has more than 350 lines"
done < <(find plugin/src -name '*.[ch]pp' -exec wc -l {} + | grep -v ' total$')

# Names of the API, as the preprocessor sees them; of the build, the environment and the tools.
names=$(mktemp)
trap 'rm -f "$names"' EXIT
{
    for header in plugin/include/frond/*.h; do "$compiler" -E -P -x c -Iplugin/include "$header"; done
    cat plugin/include/frond/*.h*
} | grep -oE '\b(frond|FROND)_\w+' | sort -u >"$names"
printf '%s\n' frond_kernels frond_command frond_float64 FROND_TESTS FROND_TOOLS FROND_IMPORTER FROND_PACKAGE_PATH FROND_ASSERT FROND_ASSERTS FROND_INSTALL FROND_SHARED FROND_STATIC FROND_FLOAT64 FROND_BUILD_PATHS >>"$names"
for page in "${pages[@]}"; do
    while IFS= read -r name; do
        grep -qxF "$name" "$names" || fail "$page: the headers have no $name"
    done < <(grep -oE '\b(frond|FROND)_\w+\b(\.(c|h|hpp))?' "$page" | grep -vE '\.(c|h|hpp)$' | sort -u)
done
while IFS= read -r name; do
    grep -qxF "$name" "$names" || fail "plugin/GLOSSARY.md: the headers have no $name"
done < <(sed -n '/^## Types of the C API/,/^## Sources/p' plugin/GLOSSARY.md | grep -oE '\bfrond_\w+' | sort -u)

# Commands: subcommands and options as `frond ... --help` lists them, scripts and tests that exist.
commands=0
while IFS=$'\t' read -r page line; do
    commands=$((commands + 1))
    read -ra words <<<"$line"
    call=("${words[@]:1:1}")
    [[ ${words[1]} =~ ^[a-z]+$ ]] || continue
    [ "${words[1]}" != bench ] || call+=("${words[2]}")
    help=$("$frond" "${call[@]}" --help 2>&1) && grep -q "Usage: frond ${call[*]}\b" <<<"$help" ||
        { fail "$page: frond has no ${call[*]}"; continue; }
    for option in $(grep -oE -- '--[a-z]+' <<<"$line" || true); do
        grep -qE -- "(^| |,)$option\b" <<<"$help" || fail "$page: frond ${call[*]} has no $option"
    done
    if [ "${words[1]}" = study ]; then
        problems=$("$frond" study) || fail "frond study lists no problems"
        for problem in "${words[@]:2}"; do
            [[ $problem =~ ^[a-z_]+$ && $problem != all ]] || continue
            grep -qw -- "$problem" <<<"$problems" || fail "$page: frond study has no problem $problem"
        done
    fi
done < <(for page in "${pages[@]}"; do
    tr '\n' ' ' <"$page" | grep -oP '`(build/release/bin/)?frond [^`]+(?=`)' | sed -E "s#^.##; s#^build/release/bin/##; s#^#$page\t#" || true
    sed -nE "s#^ {4}(frond [a-z]+ .*)#$page\t\1#; s#    .*##; s#^$page\tfrond#\0#p; s#^build/release/bin/(frond .*)#$page\t\1#p" "$page"
done | sort -u)
[ "$commands" -ge 40 ] || fail "only $commands commands were found"
for page in "${pages[@]}"; do
    for script in $(grep -oE '\b(tools|tests|plugin)/[a-z_/-]+(\.(cpp|cmake|hpp|h|md|py))?' "$page" | sort -u); do
        [ -e "$script" ] || [ "$script" = tests/placements/placements ] || fail "$page: there is no $script"
    done
done

# Lines of the examples.
while IFS=$'\t' read -r file lines; do
    [ "$(wc -l <"$file")" -eq "$lines" ] || fail "README.md: $file has $(wc -l <"$file") lines, not $lines"
done < <(grep -oP '^\| \[\w+\]\(\Kexamples/\w+\.c\).*\| \d+(?= \|)' README.md | sed -E 's#\).*\| #\t#')

# Each figure with its command: a paragraph, table or item, or the paragraph before the table or list, names one.
for page in plugin/manual/*.md; do
    awk -v page="$page" '
        function ends() {
            if (block == "") return
            figure = block ~ /[0-9] ?(ms|%|kB|us)([ ,.;:)|]|$)/ || block ~ /[0-9] times as/ || block ~ /\| [0-9.]+ \|/
            named = block ~ /`[^`]*(frond (bench|study|stability|inspect|run|export)|tests\/|tools\/|ctest|build\/release|plugin\/src)/ || block ~ /examples\//
            if (figure && !named && !intro) { print page ": a figure without its command:\n  " substr(block, 1, 120); bad = 1 }
            if (block !~ /^(\* |[0-9]+\. )/) intro = named
            block = ""
        }
        /^```/ { ends(); code = !code; next }
        code || /^    / { next }
        /^#/ { ends(); intro = 0; next }
        /^$/ { ends(); next }
        /^(\* |[0-9]+\. )/ { ends() }
        { block = block " " $0; sub(/^ /, "", block) }
        END { ends(); exit bad }' "$page" >&2 || errors=$((errors + 1))
done

[ "$errors" -eq 0 ] || { echo "$errors errors" >&2; exit 1; }
echo "${#pages[@]} pages and $commands commands agree"
