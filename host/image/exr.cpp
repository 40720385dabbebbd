// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/exr.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <half.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/limits.h"
#include "base/quote.h"
#include "image/channel_name.h"
#include "image/exr_header.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view channel_order = "RGBAXYZ";

/// Most decoded bytes that a byte of the file can encode, where a value counts as two.
std::size_t exr_expansion(Imf::Compression compression) {
    switch (compression) {
        case Imf::PIZ_COMPRESSION:
            return 65536;  // generous: blocks of zeros have almost constant size
        case Imf::DWAA_COMPRESSION:
        case Imf::DWAB_COMPRESSION:
            return 131072;  // a run of 128 bytes, or 64 equal values, are two bytes before deflate
        default:
            return 1100;  // deflate: 1032
    }
}

/// An output stream that records a failed write: Imf::OutputFile swallows the failures of its
/// destructor, which writes the table of line offsets.
class CheckedStream : public Imf::OStream {
  public:
    explicit CheckedStream(const fs::path& path)
        : OStream(path.c_str()), file_(path, std::ios::binary | std::ios::trunc) {}

    void write(const char bytes[], int count) override {
        file_.write(bytes, count);
        if (!file_) throw std::runtime_error("not all bytes could be written");
    }
    std::uint64_t tellp() override { return static_cast<std::uint64_t>(file_.tellp()); }
    void seekp(std::uint64_t position) override {
        file_.seekp(static_cast<std::streamoff>(position));
    }

    /// Throws if any byte did not reach the system.
    void close() {
        file_.close();
        if (!file_) throw std::runtime_error("not all bytes could be written");
    }

  private:
    std::ofstream file_;
};

bool printable(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
        const auto code = static_cast<unsigned char>(c);
        return code >= 0x20 && code != 0x7F;
    });
}

/// Refuses images that could not be written, or could not be read again.
void check_image(const Image& image, const std::string& place) {
    const auto refuse = [&](const std::string& why) {
        return Error(ExitCode::output, place, "cannot be written: " + why);
    };
    const std::size_t pixels = std::size_t{image.width} * image.height;
    if (pixels == 0 || image.width > limits::max_film_edge ||
        image.height > limits::max_film_edge || pixels > limits::max_film_pixels)
        throw refuse("the image is empty or too large");
    std::set<std::string> names;
    for (const Layer& layer : image.layers) {
        if (layer.channels.empty() || layer.values.size() != pixels * layer.channels.size())
            throw refuse("layer " + quote(layer.name) + " has the wrong number of values");
        if (layer.name.size() > 200 || !printable(layer.name))
            throw refuse("layer " + quote(layer.name) + " has an unusable name");
        for (const char channel : layer.channels)
            if (std::isalnum(static_cast<unsigned char>(channel)) == 0 ||
                !names.insert(full_channel_name(layer, channel)).second)
                throw refuse("layer " + quote(layer.name) + " has an unusable or repeated channel");
    }
    if (names.empty() || names.size() > limits::max_exr_channels ||
        names.size() * pixels > limits::max_exr_values)
        throw refuse("the image has no channels or too many");
}

Imf::PixelType type_in_file(const Layer& layer) {
    return layer.words ? Imf::UINT : layer.half ? Imf::HALF : Imf::FLOAT;
}

/// How the pixels of a file are compressed. ZIP takes four times as long to write as RLE, most of
/// it on the noise of light, which it makes hardly any smaller. Exact sums, the largest files by
/// far, are written seldom.
Imf::Compression compression_of(const Image& image) {
    const bool sums = std::any_of(image.layers.begin(), image.layers.end(),
                                  [](const Layer& layer) { return layer.words; });
    return sums ? Imf::ZIP_COMPRESSION : Imf::RLE_COMPRESSION;
}

Imf::Header make_header(const Image& image, const std::string& place) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = compression_of(image);
    Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec.709 with D65
    for (const auto& [key, value] : image.metadata) {
        // These strings have a meaning of their own to readers of multi-part files.
        const bool reserved = key == "name" || key == "type" || key == "view";
        if (key.empty() || key.size() > 255 || !printable(key) || reserved ||
            header.find(key) != header.end())
            throw Error(ExitCode::output, place,
                        "cannot be written: metadata cannot be named " + quote(key));
        header.insert(key, Imf::StringAttribute(value));
    }
    for (const Layer& layer : image.layers)
        for (const char channel : layer.channels)
            header.channels().insert(full_channel_name(layer, channel),
                                     Imf::Channel(type_in_file(layer)));
    return header;
}

/// The slice of one plane. OpenEXR takes one pointer type for reading and writing.
Imf::Slice plane_slice(const Layer& layer, const float* plane, std::size_t width,
                       const Imath::V2i& origin) {
    const std::ptrdiff_t first =
        static_cast<std::ptrdiff_t>(width) * origin.y + static_cast<std::ptrdiff_t>(origin.x);
    const auto address = reinterpret_cast<std::uintptr_t>(plane) -
                         static_cast<std::uintptr_t>(first) * sizeof(float);
    return {layer.words ? Imf::UINT : Imf::FLOAT, reinterpret_cast<char*>(address), sizeof(float),
            width * sizeof(float)};
}

/// The values of a layer as 16-bit floats; those beyond the largest become it.
std::vector<half> halves_of(const Layer& layer) {
    std::vector<half> values;
    values.reserve(layer.values.size());
    for (const float value : layer.values)
        values.emplace_back(std::clamp(value, -float{HALF_MAX}, float{HALF_MAX}));
    return values;
}

/// The planes of an image as the library reads them, which live as long as this does.
class WrittenPlanes {
  public:
    explicit WrittenPlanes(const Image& image) {
        const std::size_t pixels = std::size_t{image.width} * image.height;
        for (const Layer& layer : image.layers) {
            if (layer.half) halves_.push_back(halves_of(layer));
            for (std::size_t c = 0; c < layer.channels.size(); ++c)
                frame_.insert(full_channel_name(layer, layer.channels[c]),
                              layer.half ? half_slice(c * pixels, image.width)
                                         : plane_slice(layer, layer.values.data() + c * pixels,
                                                       image.width, {0, 0}));
        }
    }

    [[nodiscard]] const Imf::FrameBuffer& frame() const { return frame_; }

  private:
    Imf::Slice half_slice(std::size_t first, std::size_t width) {
        return {Imf::HALF, reinterpret_cast<char*>(halves_.back().data() + first), sizeof(half),
                width * sizeof(half)};
    }

    std::vector<std::vector<half>> halves_;
    Imf::FrameBuffer frame_;
};

/// The layer name and channel letter of a channel's full name.
std::pair<std::string, char> split_name(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    const std::string letter = dot == std::string::npos ? name : name.substr(dot + 1);
    if (letter.size() != 1) return {name, 'Y'};
    return {dot == std::string::npos ? "" : name.substr(0, dot), letter[0]};
}

/// Layers without values yet, in the order the header's channels give.
std::vector<Layer> make_layers(const Imf::ChannelList& channels, const std::string& place) {
    std::map<std::string, std::string> found;
    for (auto i = channels.begin(); i != channels.end(); ++i) {
        const auto [layer, letter] = split_name(i.name());
        std::string& letters = found[layer];
        if (letters.find(letter) != std::string::npos)
            throw input_error(place, "has two channels that mean " + quote(i.name()));
        letters += letter;
    }
    std::vector<Layer> layers;
    for (auto& [name, letters] : found) {
        const auto rank = [](char c) {
            return std::pair(std::min(channel_order.find(c), channel_order.size()), c);
        };
        std::sort(letters.begin(), letters.end(),
                  [&](char a, char b) { return rank(a) < rank(b); });
        layers.push_back({name, letters, {}});
    }
    return layers;
}

/// The full name in the file of a channel that make_layers() has placed.
std::string name_in_file(const Imf::ChannelList& channels, const Layer& layer, char channel) {
    const std::string split =
        layer.name.empty() ? std::string(1, channel) : layer.name + "." + channel;
    return channels.findChannel(split) != nullptr ? split : layer.name;
}

/// Whether a layer's bits are to be kept: integers of other programs are read as numbers.
bool holds_words(const Imf::ChannelList& channels, const Layer& layer) {
    if (!layer.name.starts_with(word_layer_prefix)) return false;
    return std::all_of(layer.channels.begin(), layer.channels.end(), [&](char c) {
        return channels.findChannel(name_in_file(channels, layer, c))->type == Imf::UINT;
    });
}

Image read_pixels(Imf::InputFile& file, std::size_t file_bytes, const std::string& place) {
    const Imath::Box2i window = file.header().dataWindow();
    const Imf::ChannelList& channels = file.header().channels();
    Image image;
    image.width = static_cast<std::uint32_t>(window.max.x - window.min.x + 1);
    image.height = static_cast<std::uint32_t>(window.max.y - window.min.y + 1);
    image.layers = make_layers(channels, place);
    const std::size_t pixels = std::size_t{image.width} * image.height;
    std::size_t total = 0;
    for (const Layer& layer : image.layers) total += layer.channels.size() * pixels;
    // A value has at least two bytes, so the file must have at least this many.
    const std::size_t expansion = exr_expansion(file.header().compression());
    if (total > limits::max_exr_values || total / expansion > file_bytes / 2)
        throw input_error(place, "claims " + std::to_string(total) +
                                     " values, more than the file can hold or the limit of " +
                                     std::to_string(limits::max_exr_values));
    Imf::FrameBuffer frame;
    for (Layer& layer : image.layers) {
        layer.values.resize(layer.channels.size() * pixels);
        layer.words = holds_words(channels, layer);
        for (std::size_t c = 0; c < layer.channels.size(); ++c)
            frame.insert(
                name_in_file(channels, layer, layer.channels[c]),
                plane_slice(layer, layer.values.data() + c * pixels, image.width, window.min));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    for (auto i = file.header().begin(); i != file.header().end(); ++i)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute()))
            image.metadata.emplace(i.name(), text->value());
    return image;
}

/// The reason an OpenEXR exception gives, on one line and without the file name it repeats.
std::string reason(const std::exception& error) {
    std::string text = error.what();
    const std::size_t path_end = text.rfind("\". ");
    if (path_end != std::string::npos) text.erase(0, path_end + 3);
    return one_line(text);
}

}  // namespace

void write_exr(const fs::path& path, const Image& image, WriteMode mode) {
    const std::string place = path.string();
    check_image(image, place);
    const Imf::Header header = make_header(image, place);
    const WrittenPlanes planes(image);
    const auto write = [&](const fs::path& temporary) {
        CheckedStream stream(temporary);
        {
            Imf::OutputFile file(stream, header);
            file.setFrameBuffer(planes.frame());
            file.writePixels(static_cast<int>(image.height));
        }
        stream.close();
    };
    write_file_atomically(path, write, mode);
}

Image read_exr(const fs::path& path) {
    const std::string place = path.string();
    check_exr_header(read_file_head(path, limits::max_exr_header_bytes), place);
    try {
        Imf::InputFile file(path.c_str());
        if (!file.isComplete()) throw input_error(place, "is cut off, expected all scan lines");
        return read_pixels(file, fs::file_size(path), place);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw input_error(place, "is damaged: " + reason(error));
    }
}

void use_exr_threads(int threads) {
    Imf::setGlobalThreadCount(threads);
}

}  // namespace weft
