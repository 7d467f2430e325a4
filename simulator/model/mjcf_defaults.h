// Attributes of MJCF elements with their default classes.
#pragma once

#include <tinyxml2.h>

#include <map>
#include <string>
#include <vector>

#include "simulator/model/mjcf_document.h"

namespace plumbline::model {

/// Looks attributes up in an element, else in its class: MJCF's <default> elements, which inherit.
class MjcfDefaults {
 public:
  MjcfDefaults() = default;
  explicit MjcfDefaults(const MjcfDocument& document);

  /// nullptr: nowhere. `childclass` is that of the bodies around.
  const char* attribute(const tinyxml2::XMLElement& element, const char* name,
                        const std::string& childclass) const;

  bool has_class(const std::string& name) const { return classes_.count(name) != 0; }

 private:
  struct Class {
    /// In several sections, of which the last counts.
    std::vector<const tinyxml2::XMLElement*> elements;
    std::string parent;  ///< empty: none
  };
  void add(const tinyxml2::XMLElement& element, const std::string& parent);

  std::map<std::string, Class> classes_;
  std::string main_ = "main";
};

}  // namespace plumbline::model
