// Forty texts that do harm if they are shown unescaped; a file or its name may contain them.
#pragma once

#include <string>
#include <vector>

namespace eyeray::engine::test {

inline const std::vector<std::string> nasty_strings = {
    // Commands of GitHub's workflows.
    "::stop-commands::x",
    "  ::error::x",
    "\t::add-mask::x",
    "##[error]x",
    "a ##[group]b",
    "a\n::error::b",
    "a\r::debug::b",
    "::",
    "##[##[",
    "a,title=b::c",
    "%0A::error::x",
    // Control characters of terminals, also those of Unicode's second block, and within other text.
    "\x1b[2J",
    "\x1b]0;title\x07",
    "\x1b_Ga=T\x1b\\",
    "\xc2\x9b"
    "31m",
    "\x7f",
    "\b\b\b",
    "a\nb",
    "a\r\nb",
    "a\vb\f",
    std::string("a\0b", 3),
    // HTML, and JSON in HTML.
    "<script>alert(1)</script>",
    "</script>",
    "<!--<script>",
    "-->",
    "<img src=x onerror=alert(1)>",
    "&lt;b&gt;",
    "\" onload=\"x",
    "' onload='x",
    "\xe2\x80\xa8",
    "\\u003c",
    "\\",
    "\"",
    // XML, Markdown and TOML.
    "]]>",
    "<![CDATA[x",
    "&#0;",
    "a | b \\| c",
    "`a` **b** [c](javascript:d)",
    "\"\"\"\n[[sphere]]",
    // No UTF-8.
    "\xff\xfe\xc0\xaf",
};

}  // namespace eyeray::engine::test
