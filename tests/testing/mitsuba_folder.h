// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_MITSUBA_FOLDER_H
#define WEFT_TESTS_TESTING_MITSUBA_FOLDER_H

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/mitsuba/mitsuba_reader.h"
#include "tests/testing/temporary_folder.h"

namespace weft {

/// A folder with a small PLY file, an image and a scene that is made of given elements.
class MitsubaFolder {
  public:
    MitsubaFolder() {
        // A square of two triangles with texture coordinates; the same with normals; one triangle
        // without either.
        write_square("square.ply", "property float u\nproperty float v\n",
                     {" 0 0", " 1 0", " 1 1", " 0 1"});
        write_square("normals.ply", "property float nx\nproperty float ny\nproperty float nz\n",
                     {" 0.1 0 1", " 0.1 0 1", " 0.1 0 1", " 0.1 0 1"});
        folder_.write("bare.ply", ply("", 3, 1) + "-1 -1 0\n1 -1 0\n-1 1 0\n3 0 1 2\n");
        folder_.write("image.tga", image());
    }

    /// Writes `elements` as the lines after the first of `s.xml` and reads it.
    Scene read(const std::string& elements) {
        return read_file("<scene version=\"3.0.0\">\n" + elements + "\n</scene>\n");
    }

    /// Reads a file of this text.
    Scene read_file(const std::string& text) {
        diagnostics_ = Diagnostics();
        return read_mitsuba(folder_.write("s.xml", text), diagnostics_);
    }

    /// The error of `read`, without folders: `s.xml:2: ...`.
    std::string error(const std::string& elements) {
        return error_of_file("<scene version=\"3.0.0\">\n" + elements + "\n</scene>\n");
    }

    std::string error_of_file(const std::string& text) {
        try {
            (void)read_file(text);
        } catch (const Error& error) {
            if (error.code() != ExitCode::bad_input) return "not an input error";
            return without_folder(error.what());
        }
        return "no error";
    }

    /// Warnings of the last `read`, without folders.
    [[nodiscard]] std::vector<std::string> warnings() const {
        std::vector<std::string> texts;
        for (const std::string& warning : diagnostics_.warnings())
            texts.push_back(without_folder(warning));
        return texts;
    }

    [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }

  private:
    static std::string ply(const std::string& properties, int vertices, int faces) {
        return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
               "\nproperty float x\nproperty float y\nproperty float z\n" + properties +
               "element face " + std::to_string(faces) +
               "\nproperty list uchar int vertex_indices\nend_header\n";
    }

    void write_square(const std::string& name, const std::string& properties,
                      const std::vector<std::string>& values) const {
        folder_.write(name, ply(properties, 4, 2) + "-1 -1 0" + values[0] + "\n1 -1 0" + values[1] +
                                "\n1 1 0" + values[2] + "\n-1 1 0" + values[3] +
                                "\n3 0 1 2\n3 0 2 3\n");
    }

    /// A TGA of 2 x 2 pixels, top row first: red, green above blue, white.
    static std::string image() {
        const std::string header("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\x18\x20", 18);
        return header + std::string("\0\0\xFF\0\xFF\0\xFF\0\0\xFF\xFF\xFF", 12);
    }

    [[nodiscard]] std::string without_folder(std::string text) const {
        const std::string prefix = folder_.path().string() + "/";
        for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
            text.erase(at, prefix.size());
        return text;
    }

    TemporaryFolder folder_;
    Diagnostics diagnostics_;
};

}  // namespace weft

#endif
