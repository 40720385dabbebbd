# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Takes Markdown pages apart for docs_commands_check.sh. The variable `mode` says what is wanted:
#   blocks    every ```sh block to a file of the folder `out`, its place in a comment on top
#   options   OPTION FILE:LINE for code spans such as `--spp N` and for weft's commands in spans
#   links     TARGET ANCHOR FILE:LINE for every link inside of the project, and for code spans that
#             name a source file; ANCHOR is - for none
#   headings  the anchors of all headings

FNR == 1 { fenced = 0; skip = 0 }

/^ *```/ {
    fenced = !fenced
    if (fenced && mode == "blocks" && $0 ~ /^```sh *$/ && !skip) {
        file = sprintf("%s/%03d.sh", out, ++blocks)
        print "# " FILENAME ":" FNR > file
    } else if (file != "") {
        close(file)
        file = ""
    }
    skip = 0
    next
}

fenced {
    if (file != "") print > file
    next
}

{ skip = $0 ~ /^<!-- not run: .+ -->$/ }

mode == "options" {
    rest = $0
    while (match(rest, /`[^`]+`/)) {
        span = substr(rest, RSTART + 1, RLENGTH - 2)
        rest = substr(rest, RSTART + RLENGTH)
        if (span !~ /^(-o|--[a-z])/ && span !~ /^(\.\/)?weft (render|merge|compare|tradeoff|info|devices|selftest)/) continue
        count = split(span, words, /[ =]/)
        for (i = 1; i <= count; ++i)
            if (words[i] ~ /^--?[a-z]/) print words[i], FILENAME ":" FNR
    }
}

mode == "links" {
    rest = $0
    while (match(rest, /`[^`]+`/)) {
        span = substr(rest, RSTART + 1, RLENGTH - 2)
        rest = substr(rest, RSTART + RLENGTH)
        if (span ~ /^(host|kernels|tests|cmake|bench|docs)\/[a-z0-9_\/.-]+$/)
            print span, "-", FILENAME ":" FNR
    }
    rest = $0
    gsub(/`[^`]*`/, "", rest)
    while (match(rest, /\]\([^) ]+\)/)) {
        target = substr(rest, RSTART + 2, RLENGTH - 3)
        rest = substr(rest, RSTART + RLENGTH)
        if (target ~ /^[a-z]+:/) continue
        anchor = "-"
        if (match(target, /#/)) {
            anchor = substr(target, RSTART + 1)
            target = substr(target, 1, RSTART - 1)
        }
        folder = FILENAME
        if (!sub(/[^\/]*$/, "", folder)) folder = ""
        print (target == "" ? FILENAME : folder target), anchor, FILENAME ":" FNR
    }
}

mode == "headings" && /^#+ / {
    heading = tolower($0)
    sub(/^#+ /, "", heading)
    gsub(/[^a-z0-9 _-]/, "", heading)
    gsub(/ /, "-", heading)
    print heading
}
