// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_SPLIT_REFERENCE_H
#define WEFT_APP_SPLIT_REFERENCE_H

#include <optional>

#include "app/compared_image.h"
#include "app/options.h"
#include "metrics/unbiased_mse.h"

namespace weft {

/// The reference of `weft compare`, and two independent images of its view where there are any: the
/// reference and --second-reference, or the halves that the reference's file holds.
class SplitReference {
  public:
    /// Reads the files that the options name. Throws Error: exit code 1 where --second-reference
    /// names the file of another image; 2 where an image cannot be used, has another size than the
    /// reference, or is not independent of it, because it has the same pixels or the same samples.
    explicit SplitReference(const CompareOptions& options);

    /// What the image is compared with.
    [[nodiscard]] const ComparedImage& whole() const { return whole_; }
    /// Whether there are two independent images.
    [[nodiscard]] bool is_split() const { return second_.has_value(); }
    /// Whether these are halves of the whole, which has less noise than they.
    [[nodiscard]] bool has_halves() const { return first_.has_value(); }
    /// The two images; only where is_split().
    [[nodiscard]] const ComparedImage& first() const { return first_ ? *first_ : whole_; }
    [[nodiscard]] const ComparedImage& second() const { return *second_; }
    [[nodiscard]] ReferenceHalves halves() const;

    /// Whether the image has the pixels of the reference or of one of the two images, so that it is
    /// not independent of them.
    [[nodiscard]] bool holds(const ComparedImage& test) const;
    /// Throws Error (exit code 2) where --second-reference was given and `holds(test)`. Without it
    /// users may well compare a reference with itself.
    void check_independent(const ComparedImage& test) const;

  private:
    void take_halves(const Image& file);
    void take_second(const CompareOptions& options, const Image& file);

    ComparedImage whole_;
    std::optional<ComparedImage> first_;
    std::optional<ComparedImage> second_;
    double first_share_ = 0.5;
};

}  // namespace weft

#endif
