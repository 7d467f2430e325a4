// An MJCF file with the files that it includes.
#pragma once

#include <tinyxml2.h>

#include <set>
#include <string>
#include <vector>

#include "simulator/trace/error.h"

namespace plumbline::model {

/// Reads an MJCF file and puts in the place of each <include file="..."/> what the root element of that file
/// holds, as MuJoCo does: paths are relative to the folder of the first file, and each file is included once.
/// Throws InputError (file, line) for text that is no XML, another root element than <mujoco>, and files that
/// are not there or included twice. Source: MuJoCo documentation, "XML Reference", version 2.2, `include`.
class MjcfDocument {
 public:
  explicit MjcfDocument(const std::string& path);

  const std::string& file() const { return file_; }
  const std::string& text() const { return text_; }
  const tinyxml2::XMLElement& root() const { return *document_.RootElement(); }
  /// All top-level elements of a name: included files may bring one each.
  std::vector<const tinyxml2::XMLElement*> sections(const char* name) const;
  /// Where an element stands: in the file itself, or in an included one.
  Place_in_file place(const tinyxml2::XMLElement& element) const;

 private:
  void append(const std::string& path, bool whole);
  void append_part(const std::string& path, const std::string& text, std::size_t begin, std::size_t end);

  struct Line {
    std::string file;
    int number = 1;
  };
  std::string file_, text_;
  std::vector<Line> lines_;  // of the text: where each is from
  std::set<std::string> included_;
  tinyxml2::XMLDocument document_;
};

}  // namespace plumbline::model
