// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_OBJ_OBJ_TEXT_H
#define WEFT_SCENE_OBJ_OBJ_TEXT_H

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// One statement of an OBJ or MTL file. The views last until the next statement is read.
struct ObjStatement {
    std::size_t line = 0;      ///< where it begins, counted from 1
    std::string_view keyword;  ///< never empty
    std::string_view rest;     ///< without blanks at either end
};

/// Cuts the text of an OBJ or MTL file into statements: lines may end in LF, CR LF or CR, and go on
/// after a backslash; empty lines, comment lines and a byte order mark are skipped.
class ObjLines {
  public:
    /// `text` must outlive this object. Throws Error (exit code 2) when it holds a NUL byte
    /// before its end.
    ObjLines(std::string_view text, std::string file);

    /// The next statement; false at the end.
    [[nodiscard]] bool next(ObjStatement& statement);

    /// `file:line` of a statement.
    [[nodiscard]] std::string place(const ObjStatement& statement) const;

  private:
    [[nodiscard]] std::string_view next_line();

    std::string_view text_;
    std::string file_;
    std::size_t offset_ = 0;
    std::size_t lines_ = 0;
    std::string joined_;  // a statement of several lines
};

/// Takes the next word off `rest`; empty at the end and where a comment begins.
[[nodiscard]] std::string_view take_word(std::string_view& rest);

/// Without the blanks at both ends.
[[nodiscard]] std::string_view trim_blanks(std::string_view text);

/// Reads a decimal number; NaN, infinity and numbers out of range come as such. False where `word`
/// is something else.
[[nodiscard]] bool read_obj_number(std::string_view word, double& value);

/// The numbers of a statement up to a comment, at most `max_count`; words beyond are left alone.
/// Throws Error (exit code 2) at a word that is not a number.
[[nodiscard]] std::vector<double> read_obj_numbers(std::string_view rest, std::size_t max_count,
                                                   const std::string& place);

}  // namespace weft

#endif
