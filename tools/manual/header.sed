# The headers' comments, as doxygen wants them marked. Tables of X-macros and rules between sections are left alone.
/^#define FROND_[A-Z_]+\(X\)/,/[^\\]$/b
/^\/\* ---- /b
# What looks like a tag or a link and is none.
/^#include/!s|<([a-z/_.]+)>|\&lt;\1\&gt;|g
s|^(//.*)#include|\1\\#include|
# A comment of its own, and one behind what it is about.
s|^( *)/\* |\1/** |
s|([^ ] +)/\* |\1/**< |
s|^( *)// |\1/// |
s|([^ ] +)// |\1///< |
