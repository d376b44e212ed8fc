#!/usr/bin/env bash
# Writes a page of the manual as doxygen reads it. In: a .md file. A page of plugin/manual gets the label manual_NAME, and links to
# pages become references to labels; pictures go by their names, other files of the source tree become words.
set -euo pipefail
folder='(\.\./)*(examples|plugin|tools|include|models|LICENCE|DESIGN|GLOSSARY|RELEASE_NOTES)'
label=""
case $1 in */plugin/manual/*) label=" {#manual_$(basename "$1" .md)}" ;; esac
sed -E -e "1s|\$|$label|" \
    -e 's#!\[([^]]*)\]\((\.\./)*examples/pictures/([^)]*)\)#![\1](\3)#g' \
    -e 's#\]\((plugin/manual/)?([a-z_]+)\.md\)#](@ref manual_\2)#g' \
    -e "s#(^|[^!])\[([^]]*)\]\($folder[^)]*\)#\1\2#g" \
    -e "s#(^|[^!])\[([^]]*)\]\($folder[^)]*\)#\1\2#g" "$1"
