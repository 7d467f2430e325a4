#include "simulator/model/mjcf_document.h"

#include <algorithm>
#include <filesystem>

#include "simulator/model/xml_text.h"
#include "simulator/trace/file_text.h"

namespace plumbline::model {
namespace {

namespace fs = std::filesystem;

int line_at(const std::string& text, std::size_t position) {
  return 1 + static_cast<int>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n'));
}

void collect_includes(const XmlNode& node, std::vector<const XmlNode*>& includes) {
  for (const XmlNode& child : node.children) {
    if (child.name == "include") {
      includes.push_back(&child);
    } else {
      collect_includes(child, includes);
    }
  }
}

void refuse_no_xml(const std::string& path, const std::string& text) {
  tinyxml2::XMLDocument alone;
  if (alone.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError({path, alone.ErrorLineNum(), ""},
                     std::string("text that is no XML (") + alone.ErrorName() + ")", "a whole MJCF file");
  }
}

}  // namespace

MjcfDocument::MjcfDocument(const std::string& path) : file_(path) {
  append(path, true);
  document_.Parse(text_.data(), text_.size());
  const tinyxml2::XMLElement* root = document_.RootElement();
  if (root == nullptr || std::string(root->Name()) != "mujoco") {
    throw InputError({file_, 1, ""}, "no root element <mujoco>", "an MJCF file");
  }
}

void MjcfDocument::append(const std::string& path, bool whole) {
  const std::string text = read_text(path);
  refuse_no_xml(path, text);
  const XmlText xml(path, text);
  const XmlNode& root = xml.root();
  std::vector<const XmlNode*> includes;
  collect_includes(root, includes);
  std::size_t at = whole ? 0 : root.empty_tag ? root.end : root.open_end;
  for (const XmlNode* include : includes) {
    const Place_in_file place{path, line_at(text, include->begin), "include"};
    const std::string name = xml.value(*include, "file");
    const fs::path other = fs::path(file_).parent_path() / name;
    std::error_code none;
    if (name.empty() || !fs::is_regular_file(other, none)) {
      throw InputError(place, "no file \"" + name + "\"", "an MJCF file in the folder of " + file_);
    }
    if (!included_.insert(other.lexically_normal().string()).second) {
      throw InputError(place, "\"" + name + "\" a second time", "each file included once");
    }
    append_part(path, text, at, include->begin);
    append(other.string(), false);
    at = include->end;
  }
  append_part(path, text, at,
              whole ? text.size() : std::max(at, root.empty_tag ? root.end : root.content_end));
}

void MjcfDocument::append_part(const std::string& path, const std::string& text, std::size_t begin,
                               std::size_t end) {
  if (!text_.empty()) {
    text_ += '\n';  // each piece begins a line of its own
  }
  lines_.push_back({path, line_at(text, begin)});
  for (std::size_t i = begin; i < end; ++i) {
    text_ += text[i];
    if (text[i] == '\n') {
      lines_.push_back({path, lines_.back().number + 1});
    }
  }
}

std::vector<const tinyxml2::XMLElement*> MjcfDocument::sections(const char* name) const {
  std::vector<const tinyxml2::XMLElement*> found;
  for (const tinyxml2::XMLElement* one = root().FirstChildElement(name); one != nullptr;
       one = one->NextSiblingElement(name)) {
    found.push_back(one);
  }
  return found;
}

Place_in_file MjcfDocument::place(const tinyxml2::XMLElement& element) const {
  const auto index = static_cast<std::size_t>(std::max(element.GetLineNum(), 1) - 1);
  const Line& line = lines_[std::min(index, lines_.size() - 1)];
  const char* name = element.Attribute("name");
  return {line.file, line.number, name != nullptr ? name : element.Name()};
}

}  // namespace plumbline::model
