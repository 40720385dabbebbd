// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SESSION_FILE_OUTPUT_H
#define WEFT_SESSION_FILE_OUTPUT_H

#include <filesystem>
#include <optional>
#include <string>

#include "base/diagnostics.h"
#include "base/file.h"
#include "image/background.h"
#include "image/png.h"
#include "image/tone.h"
#include "session/output_driver.h"

namespace weft {

/// Which files an image is written to.
struct FileOutputSettings {
    std::filesystem::path file;         ///< a PNG file where it ends in .png, in any case, else EXR
    std::optional<double> exposure_ev;  ///< stops, for PNG; empty means automatic
    ToneCurve tone = ToneCurve::none;   ///< for PNG
    std::optional<Background> background;       ///< empty: none but what was rendered
    bool overlays = false;                      ///< of ais: also what was sampled, and why
    std::optional<std::filesystem::path> sums;  ///< EXR file that path tracing saves its sums to
    double save_interval_ms = 60000.0;          ///< between two times that it does, above 0
    bool with_sums = false;                     ///< of path tracing: `file` gets its sums, too
    std::string scene;                          ///< its name, for the metadata
};

/// Sets the image's metadata, as files have it.
void describe(SessionImage& rendered, const FileOutputSettings& settings);

/// How the image becomes a PNG file.
[[nodiscard]] PngSettings png_settings(const Image& image, const FileOutputSettings& settings);

/// Writes each image, and the sums of path tracing, to files.
class FileOutput : public OutputDriver {
  public:
    explicit FileOutput(FileOutputSettings settings, Diagnostics& diagnostics)
        : settings_(std::move(settings)), diagnostics_(diagnostics) {}

    /// Writes the next images to another file.
    void set_file(std::filesystem::path file) { settings_.file = std::move(file); }

    /// Throws Error (exit code 5), like `save`.
    void write(SessionImage rendered) override;
    /// Writes some lines of the image beside its name, removes them, and concludes.
    [[nodiscard]] double write_ms(const SessionImage& image) override;
    [[nodiscard]] std::optional<double> save_interval_ms() const override;
    void save(const FilmSums& sums, const Image& image) override;

  private:
    void write_files(SessionImage& rendered, WriteMode mode);
    void save_sums(const FilmSums& sums, const Image& image, WriteMode mode);
    /// Milliseconds that each `step`-th line of the image takes to be written.
    [[nodiscard]] double lines_ms(const SessionImage& image, std::uint32_t step);

    FileOutputSettings settings_;
    Diagnostics& diagnostics_;
};

}  // namespace weft

#endif
