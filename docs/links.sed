# What Doxygen cannot follow in a page of Markdown: pictures by their folders, headings of other pages and of the same
# one, and files that are no pages, but for the headers. The text of a link may not go on in the next line.
:join
/\[[^][]*$/{
$!{
N
s,\(\[[^][]*\)\n *\([^][]*\](\),\1 \2,
b join
}
}
s,\](\(\.\./\)*\(docs/\)*images/,](,g
s,\(\]([^():]*\.md\)#[a-z0-9-]*),\1),g
s,\[\([^]]*\)\](#[a-z0-9-]*),\1,g
s,\[`icc/\([a-z.]*\)`\]([^()]*),@ref icc/\1 "icc/\1",g
s,\[\([^]`]*\)\]([^()]*include/icc/\([a-z.]*\)),@ref icc/\2 "\1",g
s,\[`\([^`]*\)`\](\([^():]*\)\.\(c\|d\.ts\|h\|hpp\|ipynb\|js\|py\|rs\|sh\|[135]\)),`\1`,g
