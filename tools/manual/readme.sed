# Pictures by their names, files of the source tree as words.
s|!\[([^]]*)\]\(examples/pictures/([^)]*)\)|![\1](\2)|g
s|([^!])\[([^]]*)\]\((examples\|plugin\|tools\|LICENCE)[^)]*\)|\1\2|g
s|^\[([^]]*)\]\((examples\|plugin\|tools\|LICENCE)[^)]*\)|\1|g
