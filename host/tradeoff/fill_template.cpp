// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/fill_template.h"

#include <kainjow/mustache.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tradeoff/html_text.h"

namespace weft {
namespace {

namespace mustache = kainjow::mustache;

mustache::data to_data(const nlohmann::json& value) {
    if (value.is_boolean()) return value.get<bool>();
    if (value.is_string()) {
        const auto& text = value.get_ref<const std::string&>();
        return text.empty() ? mustache::data(false) : mustache::data(text);
    }
    if (value.is_array()) {
        mustache::data list(mustache::data::type::list);
        for (const nlohmann::json& part : value) list << to_data(part);
        return list;
    }
    if (value.is_object()) {
        mustache::data object;
        for (const auto& [name, part] : value.items()) object[name] = to_data(part);
        return object;
    }
    throw std::invalid_argument(std::string("template: a value is a ") + value.type_name() +
                                ", expected text, a boolean, a list or an object");
}

/// Looks names up; Mustache itself shows nothing for one that it does not find.
class StrictContext : public mustache::context<std::string> {
  public:
    using mustache::context<std::string>::context;

    [[nodiscard]] const mustache::data* get(const std::string& name) const override {
        const mustache::data* found = mustache::context<std::string>::get(name);
        if (found == nullptr)
            throw std::invalid_argument("template: there is no value '" + name + "'");
        return found;
    }
    /// A partial would be a value taken for a template.
    [[nodiscard]] const mustache::data* get_partial(const std::string& name) const override {
        throw std::invalid_argument("template: there are no partials, such as '" + name + "'");
    }
};

}  // namespace

std::string fill_template(std::string_view text, const nlohmann::json& values) {
    mustache::mustache parsed{std::string(text)};
    if (!parsed.is_valid()) throw std::invalid_argument("template: " + parsed.error_message());
    parsed.set_custom_escape([](const std::string& value) { return escape_markup(value); });
    const mustache::data data = to_data(values);
    StrictContext context(&data);
    return parsed.render(context);
}

}  // namespace weft
