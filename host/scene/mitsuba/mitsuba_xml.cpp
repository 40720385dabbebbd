// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <functional>
#include <map>
#include <pugixml.hpp>
#include <string_view>
#include <system_error>

#include "base/error.h"
#include "base/file.h"
#include "base/limits.h"
#include "base/quote.h"

namespace weft::mitsuba {

namespace {

namespace fs = std::filesystem;

struct TagRule {
    std::string_view tag;
    std::string_view attributes;  ///< those it may have, separated by blanks
};

/// The tags of the format. Objects have `type`, `id` and `name`, values `name` and `value`.
constexpr std::array<TagRule, 35> tag_rules = {{
    {"scene", "version"},
    {"default", "name value"},
    {"include", "filename"},
    {"alias", "id as"},
    {"ref", "id name"},
    {"integrator", "type id name"},
    {"sensor", "type id name"},
    {"film", "type id name"},
    {"sampler", "type id name"},
    {"rfilter", "type id name"},
    {"bsdf", "type id name"},
    {"texture", "type id name"},
    {"emitter", "type id name"},
    {"shape", "type id name"},
    {"medium", "type id name"},
    {"phase", "type id name"},
    {"volume", "type id name"},
    {"integer", "name value"},
    {"float", "name value"},
    {"boolean", "name value"},
    {"string", "name value"},
    {"rgb", "id name value"},
    {"spectrum", "type id name value filename"},
    {"point", "name value x y z"},
    {"vector", "name value x y z"},
    {"transform", "id name"},
    {"translate", "value x y z"},
    {"scale", "value x y z"},
    {"rotate", "value x y z angle"},
    {"lookat", "origin target up"},
    {"matrix", "value"},
    {"path", "value"},
    {"resources", ""},
    {"animation", "name"},
    {"blackbody", "name temperature"},
}};

const TagRule* find_rule(std::string_view tag) {
    const auto* const found = std::find_if(tag_rules.begin(), tag_rules.end(),
                                           [&](const TagRule& rule) { return rule.tag == tag; });
    return found == tag_rules.end() ? nullptr : found;
}

bool allows(const TagRule& rule, std::string_view attribute) {
    std::string_view rest = rule.attributes;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        if (rest.substr(0, end) == attribute) return true;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
}

/// One file of the scene while it is converted; turns byte offsets into lines.
struct SourceFile {
    fs::path path;
    const std::string* name = nullptr;
    std::vector<std::size_t> line_ends;

    [[nodiscard]] std::size_t line(std::ptrdiff_t offset) const {
        const auto wanted = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
        const auto found = std::lower_bound(line_ends.begin(), line_ends.end(), wanted);
        return static_cast<std::size_t>(found - line_ends.begin()) + 1;
    }
};

class Loader {
  public:
    Loader(Warnings& warnings, Document& document) : warnings_(warnings), document_(document) {}

    void load(const fs::path& path) {
        document_.path = path;
        load_file(path, {}, document_.root, 0);
        index_ids(document_.root);
        apply_aliases();
    }

  private:
    /// Parses a file and adds the children of its `<scene>` to `root`.
    void load_file(const fs::path& path, const std::string& place, Element& root, int depth) {
        const std::vector<std::byte> bytes = read_file(path, limits::max_text_file_bytes, place);
        document_.files.push_back(path.string());
        SourceFile file{path, &document_.files.back(), {}};
        scan(bytes, file);
        pugi::xml_document xml;
        const pugi::xml_parse_result result =
            xml.load_buffer(bytes.data(), bytes.size(), pugi::parse_default, pugi::encoding_utf8);
        if (!result)
            throw input_error(fmt::format("{}:{}", *file.name, file.line(result.offset)),
                              std::string("broken XML: ") + result.description());
        const pugi::xml_node scene = xml.document_element();
        const bool is_scene = std::strcmp(scene.name(), "scene") == 0;
        if (depth == 0 && !is_scene)
            throw input_error(
                fmt::format("{}:{}", *file.name, file.line(scene.offset_debug())),
                "root element " + quote(scene.name()) + ", expected the <scene> of a Mitsuba file");
        if (scene.next_sibling())
            throw input_error(
                fmt::format("{}:{}", *file.name, file.line(scene.next_sibling().offset_debug())),
                "a second root element, expected one <scene>");
        if (depth == 0) {
            root = make_element(scene, file);
            check_version(root);
        }
        open_files_.push_back(canonical(path));
        // What is included may be one object, without a scene around it.
        if (is_scene)
            convert_children(scene, file, root, depth + 1);
        else
            convert(scene, file, root, depth + 1);
        open_files_.pop_back();
    }

    /// Finds the line ends, and refuses files that need far more memory as a tree than as text.
    void scan(const std::vector<std::byte>& bytes, SourceFile& file) {
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            const char c = static_cast<char>(bytes[i]);
            if (c == '\n') file.line_ends.push_back(i);
            if ((c == '<' || c == '=') && ++items_ > limits::max_xml_items)
                throw input_error(
                    fmt::format("{}:{}", *file.name, file.line_ends.size() + 1),
                    fmt::format("more than {} tags and attributes", limits::max_xml_items));
        }
    }

    static fs::path canonical(const fs::path& path) {
        std::error_code error;
        fs::path result = fs::weakly_canonical(path, error);
        return error ? path.lexically_normal() : result;
    }

    static void check_version(const Element& scene) {
        const std::string& version = scene.required("version");
        const bool known =
            version.size() > 1 && (version[0] == '2' || version[0] == '3') && version[1] == '.';
        if (!known)
            throw input_error(scene.place(), "scene version " + quote(version) +
                                                 ", expected 2.x or 3.x (older files use other "
                                                 "names; Mitsuba 3 can convert them)");
    }

    /// The element alone: name, place and substituted attributes.
    Element make_element(const pugi::xml_node& node, const SourceFile& file) {
        Element element;
        element.tag = node.name();
        element.file = file.name;
        element.line = file.line(node.offset_debug());
        const TagRule* const rule = find_rule(element.tag);
        if (rule == nullptr) return element;
        for (const pugi::xml_attribute& attribute : node.attributes()) {
            if (element.attribute(attribute.name()) != nullptr)
                throw input_error(element.place(), "attribute " + quote(attribute.name()) +
                                                       " is given twice, expected it once");
            if (is_root(node) && std::strcmp(attribute.name(), "version") == 0 &&
                !allows(*rule, attribute.name()))
                continue;
            if (!allows(*rule, attribute.name())) {
                warnings_.once(element, fmt::format("attribute {} of <{}> is not known, ignored",
                                                    quote(attribute.name()), element.tag));
                continue;
            }
            element.attributes.emplace_back(attribute.name(),
                                            substitute(attribute.value(), element));
        }
        return element;
    }

    void convert_children(const pugi::xml_node& node, const SourceFile& file, Element& parent,
                          int depth) {
        for (const pugi::xml_node& child : node.children()) {
            if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
                warnings_.once(parent, "text between elements is ignored");
            else if (child.type() == pugi::node_element)
                convert(child, file, parent, depth);
        }
    }

    /// Whether a node is the outermost one of its file.
    static bool is_root(const pugi::xml_node& node) {
        return node.parent().type() == pugi::node_document;
    }

    void convert(const pugi::xml_node& node, const SourceFile& file, Element& parent, int depth) {
        Element element = make_element(node, file);
        if (depth > limits::max_nesting)
            throw input_error(element.place(), fmt::format("elements nested deeper than {} levels",
                                                           limits::max_nesting));
        if (find_rule(element.tag) == nullptr) {
            warnings_.once(element, "element " + quote(element.tag) + " is not known, ignored");
        } else if (element.tag == "default") {
            add_parameter(element);
        } else if (element.tag == "include") {
            include(element, parent, depth);
        } else if (element.tag == "path") {
            if (!is_root(node.parent()))
                throw input_error(element.place(),
                                  "<path> inside of an object, expected it in the <scene>");
            add_folder(element, file);
        } else {
            convert_children(node, file, element, depth + 1);
            parent.children.push_back(std::move(element));
        }
    }

    /// The first value of a name counts.
    void add_parameter(const Element& element) {
        const std::string& name = element.required("name");
        if (name.empty() || name.size() > limits::max_name_bytes)
            throw input_error(element.place(), fmt::format("a parameter's name of {} bytes, "
                                                           "expected 1 to {}",
                                                           name.size(), limits::max_name_bytes));
        longest_parameter_ = std::max(longest_parameter_, name.size());
        parameters_.emplace(name, element.required("value"));
    }

    /// Adds the folder of a `<path>`, which is relative to the file that names it, or to a folder
    /// that is searched.
    void add_folder(const Element& element, const SourceFile& file) {
        if (document_.folders.size() == limits::max_xml_includes)
            throw input_error(element.place(),
                              fmt::format("more than {} <path>s", limits::max_xml_includes));
        const std::string& value = element.required("value");
        std::error_code error;
        fs::path folder = resolve_reference(file.path, value, element.place(), false);
        if (!fs::is_directory(folder, error)) folder = document_.find_file(value, element.place());
        if (!fs::is_directory(folder, error))
            throw input_error(element.place(), "folder " + quote(folder.string()) +
                                                   " is missing, expected a folder of files");
        document_.folders.push_back(folder);
    }

    void include(const Element& element, Element& parent, int depth) {
        const fs::path path = document_.find_file(element.required("filename"), element.place());
        const fs::path key = canonical(path);
        if (std::find(open_files_.begin(), open_files_.end(), key) != open_files_.end())
            throw input_error(element.place(), "file " + quote(path.string()) +
                                                   " includes itself, expected no cycle");
        if (++includes_ > limits::max_xml_includes)
            throw input_error(element.place(),
                              fmt::format("more than {} includes", limits::max_xml_includes));
        load_file(path, element.place(), parent, depth);
    }

    /// The parameter whose name a text begins with, the longest of several; null where there is
    /// none.
    [[nodiscard]] const std::pair<const std::string, std::string>* parameter_at(
        std::string_view text) const {
        std::size_t length = std::min(text.size(), longest_parameter_);
        for (; length > 0; --length) {
            const auto found = parameters_.find(text.substr(0, length));
            if (found != parameters_.end()) return &*found;
        }
        return nullptr;
    }

    /// Replaces every `$name`. The total length is limited, since parameters may be built from
    /// parameters and so double in length again and again.
    std::string substitute(std::string_view text, const Element& element) {
        std::string result;
        while (true) {
            const std::size_t dollar = text.find('$');
            result += text.substr(0, dollar);
            if (dollar == std::string_view::npos) return result;
            text.remove_prefix(dollar + 1);
            const auto* const found = parameter_at(text);
            if (found == nullptr)
                throw input_error(element.place(),
                                  "parameter " + quote("$" + std::string(word_at(text))) +
                                      " is not defined, expected a <default> before it");
            expanded_bytes_ += found->second.size();
            if (expanded_bytes_ > limits::max_xml_expanded_bytes)
                throw input_error(element.place(),
                                  fmt::format("parameters expand to more than {} bytes",
                                              limits::max_xml_expanded_bytes));
            result += found->second;
            text.remove_prefix(found->first.size());
        }
    }

    /// The letters, digits and underscores that a text begins with.
    static std::string_view word_at(std::string_view text) {
        std::size_t length = 0;
        while (length < text.size() &&
               (std::isalnum(static_cast<unsigned char>(text[length])) != 0 || text[length] == '_'))
            ++length;
        return text.substr(0, length);
    }

    void index_ids(const Element& parent) {
        for (const Element& child : parent.children) {
            const std::string* const id = child.attribute("id");
            if (id != nullptr && child.tag != "ref" && child.tag != "alias") {
                const auto [entry, added] = document_.ids.emplace(*id, &child);
                if (!added)
                    throw input_error(child.place(), "id " + quote(*id) + " is already used at " +
                                                         entry->second->place() +
                                                         ", expected another");
            }
            index_ids(child);
        }
    }

    void apply_aliases() {
        for (const Element& child : document_.root.children) {
            if (child.tag != "alias") continue;
            const Element& target = document_.resolve(child);
            if (!document_.ids.emplace(child.required("as"), &target).second)
                throw input_error(child.place(), "id " + quote(child.required("as")) +
                                                     " is already used, expected another");
        }
    }

    Warnings& warnings_;
    Document& document_;
    std::map<std::string, std::string, std::less<>> parameters_;
    std::size_t longest_parameter_ = 0;  ///< bytes of the longest name
    std::vector<fs::path> open_files_;
    std::size_t items_ = 0;
    std::size_t includes_ = 0;
    std::size_t expanded_bytes_ = 0;
};

}  // namespace

std::string Element::place() const {
    return fmt::format("{}:{}", *file, line);
}

const std::string* Element::attribute(const std::string& name) const {
    const auto found = std::find_if(attributes.begin(), attributes.end(),
                                    [&](const auto& entry) { return entry.first == name; });
    return found == attributes.end() ? nullptr : &found->second;
}

const std::string& Element::required(const std::string& name) const {
    const std::string* const value = attribute(name);
    if (value == nullptr)
        throw input_error(place(),
                          fmt::format("<{}> without attribute '{}', expected one", tag, name));
    return *value;
}

const Element& Document::resolve(const Element& element) const {
    if (element.tag != "ref" && element.tag != "alias") return element;
    const std::string& id = element.required("id");
    const auto found = ids.find(id);
    if (found == ids.end())
        throw input_error(element.place(), "reference to unknown id " + quote(id) +
                                               ", expected the id of an object");
    return *found->second;
}

fs::path Document::find_file(const std::string& reference, const std::string& place) const {
    // Checks the reference, whichever folder has it.
    fs::path beside = resolve_reference(path, reference, place, false);
    std::error_code error;
    for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) {
        fs::path candidate = *folder / reference;
        if (fs::exists(candidate, error)) return candidate;
    }
    return beside;
}

void Warnings::count(const Element& element, WarningUnit unit, const std::string& message) {
    collector_.count(element.place(), unit, message);
}

void Warnings::once(const Element& element, const std::string& message) {
    collector_.once(element.place(), message);
}

void load_document(const fs::path& path, Warnings& warnings, Document& document) {
    Loader(warnings, document).load(path);
}

}  // namespace weft::mitsuba
