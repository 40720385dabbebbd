// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_OPTIONS_H
#define WEFT_APP_OPTIONS_H

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/algorithm_options.h"
#include "app/frame_options.h"
#include "app/parse_values.h"
#include "app/progress.h"
#include "app/reading_options.h"
#include "film/film_sums.h"
#include "image/background.h"
#include "image/tone.h"
#include "plan/denoiser.h"
#include "plan/preset.h"
#include "render/camera_placement.h"
#include "scene/animation.h"
#include "tev/tev_connection.h"

namespace CLI {
class App;
}

namespace weft {

/// The backend that runs kernels: an OpenCL device, the native build tracing with Embree, or the
/// native build tracing with Weft's own BVH.
enum class Backend { opencl, embree, native };

/// The largest exposure that images are given, up or down, stops.
inline constexpr double max_exposure_ev = 100.0;

/// The name the command line uses.
[[nodiscard]] std::string_view to_string(Backend backend);
/// The name the command line uses.
[[nodiscard]] std::string_view to_string(ProgressMode mode);
/// Reads --progress of a command. Throws Error (exit code 1).
[[nodiscard]] ProgressMode read_progress(const CLI::App& command);

/// Options of `weft render`. What is empty was not given, and the renderer chooses it.
struct RenderOptions {
    std::filesystem::path scene;
    std::filesystem::path output;  ///< ends in .exr or .png, in any case
    Algorithm algorithm = default_algorithm;
    Quality quality = Quality::preview;                ///< without a preset
    std::optional<std::filesystem::path> preset_file;  ///< of settings
    std::optional<Preset> preset;                      ///< content of preset_file
    /// Of ais and amax; default: of ais rays in open scenes, else VPLs.
    std::optional<IndirectSource> indirect;
    std::optional<std::uint32_t> cache_records;  ///< of tic: most records kept, 1 and up
    bool cache_masks = true;                     ///< of tic
    std::optional<std::uint32_t> cache_rays;     ///< of irradiance_cache: rays of a record
    std::optional<double> cache_error;           ///< of irradiance_cache: 0 to 1
    bool compensation = false;                   ///< of all that gather VPLs by pixels
    std::optional<Backend> backend;
    std::optional<std::string> device;       ///< an index if all digits (fits 32 bits), else a name
    std::optional<std::uint32_t> threads;    ///< 1 and up
    std::uint32_t tile = 64;                 ///< edge in pixels, 1 to 4096
    std::optional<FilmSize> size;            ///< default: the scene's
    std::optional<std::string> camera;       ///< default: the scene's first
    CameraPlacement placement;               ///< what is different of it
    std::optional<FrameRange> frames;        ///< of the animation; default: one image of it at rest
    std::optional<std::uint32_t> frame;      ///< instead: one image, of that frame
    double frame_rate = default_frame_rate;  ///< frames per second, above 0
    std::optional<std::filesystem::path> edits;  ///< what changes in the frames; see read_edits
    std::optional<std::vector<std::string>> components;  ///< of choosable_components
    std::optional<std::uint32_t> spp;                    ///< samples per pixel, 1 and up
    std::optional<SampleRange> samples;                  ///< of path tracing: only these
    bool keep_complete = false;                          ///< an output with just these samples
    std::optional<double> target_error;                  ///< of path tracing: ends it, above 0
    std::optional<std::filesystem::path> resume;  ///< of path tracing: sums, read and written
    double checkpoint_seconds = 60.0;             ///< between two times that they are written
    std::optional<std::uint32_t> most_bounces{};  ///< of path
    bool through_centres = false;                 ///< of path tracing
    Denoiser denoiser = Denoiser::none;
    SceneReading reading;
    std::optional<double> time_seconds;   ///< total wall time, above 0
    std::optional<double> frame_seconds;  ///< of ais: wall time of each frame, above 0
    std::uint32_t seed = 0;
    bool overlays = false;                    ///< of ais: PNG images of what was sampled, and why
    std::optional<double> exposure_ev = 0.0;  ///< stops, for PNG; empty means automatic
    ToneCurve tone = ToneCurve::none;         ///< for PNG
    std::optional<Background> background;     ///< default: the environment
    bool object_mattes = false;               ///< identifiers as layers of an .exr output
    bool material_mattes = false;             ///< likewise
    std::optional<TevAddress> tev;            ///< the viewer that shows the image meanwhile
    std::optional<std::filesystem::path> stats;
    ProgressMode progress = ProgressMode::automatic;
    bool verbose = false;  ///< names every place of a warning

    /// Whether --components is given and lists this one.
    [[nodiscard]] bool names_component(std::string_view name) const;
    /// Whether indirect light comes from irradiance records.
    [[nodiscard]] bool caches_indirect() const {
        return weft::caches_indirect(algorithm, indirect.value_or(IndirectSource::vpl));
    }
    /// The frames of the animation that images are made of; empty: it is at rest.
    [[nodiscard]] std::optional<FrameRange> chosen_frames() const {
        return frame ? std::optional(FrameRange{*frame, *frame + 1}) : frames;
    }
    /// Whether irradiance records outlast their frame.
    [[nodiscard]] bool keeps_records() const {
        return algorithm == Algorithm::tic || indirect == IndirectSource::tic;
    }
};

/// Options of `weft view`.
struct ViewOptions {
    RenderOptions image;                ///< what it begins with
    std::optional<std::uint16_t> port;  ///< default: a free one
    std::optional<std::filesystem::path> socket;
    std::filesystem::path folder;  ///< where images are saved; empty: nowhere
};

/// Options of `weft info`.
struct InfoOptions {
    std::filesystem::path scene;
    SceneReading reading;
    bool json = false;
    bool verbose = false;  ///< as RenderOptions::verbose
};

/// Options of `weft devices`.
struct DevicesOptions {
    bool json = false;
    bool check = false;  ///< tries all again, and fails where one fails
};

/// Options of `weft selftest`. What is empty was not given.
struct SelftestOptions {
    std::optional<Backend> backend;             ///< default: all there are
    std::optional<std::string> device;          ///< as RenderOptions::device
    std::vector<int> cases;                     ///< their numbers; empty means all
    std::optional<std::filesystem::path> json;  ///< results are written there, too
    bool ledger = false;                        ///< lists all checks without running them
};

/// The metrics of `weft compare`.
enum class Metric {
    hdrvdp,
    flip,
    hdrflip,
    relmse,
    relmse_trimmed,
    mape,
    bias,
    mean_ratio,
    psnr,
    ssim,
    pu21_psnr,
    pu21_ssim,
    unbiased_mse,
    unbiased_relmse,
};

/// The name the command line and JSON use.
[[nodiscard]] std::string_view to_string(Metric metric);

/// Options of `weft compare`. What is empty was not given.
struct CompareOptions {
    std::filesystem::path reference;
    std::filesystem::path test;
    std::optional<std::filesystem::path> second_reference;
    std::vector<Metric> metrics;               ///< in the order given, each once; empty means all
    std::optional<double> luminance_scale;     ///< cd/m^2 of the value 1
    std::optional<double> ppd;                 ///< pixels per degree, 1 to 1000
    std::optional<std::filesystem::path> map;  ///< ends in .png, in any case
    std::optional<std::string> layer;          ///< default: the layer without a name
    bool json = false;
    bool legacy_fan = false;
    bool legacy_otf_grid = false;
};

/// Options of `weft merge`.
struct MergeOptions {
    std::vector<std::filesystem::path> parts;  ///< at least one, but with `missing`
    std::filesystem::path output;              ///< ends in .exr; empty with `missing`
    std::optional<SampleRange> expect;         ///< the samples that the whole has to have
    /// Only tell which of so many parts of `expect` are not there; files that are missing are not
    /// errors then.
    std::optional<std::uint32_t> missing;
};

enum class ErrorMeasure : std::uint8_t;

/// Options of `weft tradeoff`. What is empty was not given.
struct TradeoffOptions {
    std::filesystem::path scene;
    SceneReading reading;
    std::filesystem::path output;  ///< a folder
    bool quick = false;
    std::optional<Backend> backend;
    std::optional<std::string> device;                ///< as RenderOptions::device
    std::optional<std::uint32_t> threads;             ///< 1 and up
    std::optional<FilmSize> size;                     ///< default: the scene's
    std::optional<std::string> camera;                ///< default: the scene's first
    std::uint32_t seed = 0;                           ///< of the first image of each setting
    std::vector<std::string> algorithms;              ///< only these; empty means all
    std::uint32_t repetitions = 5;                    ///< images of each setting, 2 and up
    std::uint32_t reference_spp = 1024;               ///< 2 and up
    bool reference_spp_given = false;                 ///< else a reference with good_floor will do
    std::optional<std::filesystem::path> references;  ///< folder
    std::vector<double> budgets_ms;                   ///< ascending, each once
    std::vector<double> errors;                       ///< likewise
    ErrorMeasure measure{};                           ///< for the front and the advice
    std::optional<std::filesystem::path> others;      ///< images by other renderers
    bool verify = false;
    ProgressMode progress = ProgressMode::automatic;
    bool verbose = false;  ///< as RenderOptions::verbose
};

/// `--help` or `--version`: text for standard output, after which the program ends well.
struct HelpText {
    std::string text;
};

/// One command, ready to run.
using ParsedCommand =
    std::variant<HelpText, RenderOptions, ViewOptions, MergeOptions, CompareOptions, InfoOptions,
                 DevicesOptions, SelftestOptions, TradeoffOptions>;

/// Reads a whole command line, `argv[0]` being the program's name. Reads no file except that of
/// --preset. Throws Error with one line: exit code 1, which option is wrong and what was expected;
/// or exit code 2, what is wrong with that file.
[[nodiscard]] ParsedCommand parse_command_line(int argc, const char* const* argv);

/// Every option by its name on the command line, for `--stats`; null for what is empty. To record
/// effective values, first fill in those that the renderer has chosen.
[[nodiscard]] nlohmann::json options_json(const RenderOptions& options);

}  // namespace weft

#endif
