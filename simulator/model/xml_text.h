// The text of an XML file with values exchanged in place: comments, order, spaces and quotes stay as they
// are.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace plumbline::model {

/// An attribute; `value_begin` to `value_end` lies between its quotes.
struct XmlAttribute {
  std::string name;
  std::size_t begin = 0, value_begin = 0, value_end = 0, end = 0;
};

/// An element and where its parts stand in the text.
struct XmlNode {
  std::string name;
  std::size_t begin = 0, name_end = 0;   ///< of "<name"
  std::size_t open_end = 0;              ///< after the ">" of the start tag
  std::size_t content_end = 0, end = 0;  ///< before and after "</name>"
  bool empty_tag = false;                ///< <name/>
  std::vector<XmlAttribute> attributes;
  std::vector<XmlNode> children;

  const XmlAttribute* attribute(const std::string& name) const;  ///< or nullptr
  const XmlNode* child(const std::string& name) const;           ///< the first, or nullptr
  std::vector<const XmlNode*> all(const std::string& name) const;
};

/// Collects edits, and applies them all at once. The text must be well-formed (a parser has read it before);
/// where it is not, the constructor throws InputError. An element is edited once: its attributes or content,
/// or its children.
class XmlText {
 public:
  XmlText(const std::string& file, std::string text);

  const XmlNode& root() const { return root_; }
  /// The value between the quotes, entities as they stand.
  std::string value(const XmlNode& node, const std::string& attribute) const;

  void set_attribute(const XmlNode& node, const std::string& name, const std::string& value);
  void remove_attribute(const XmlNode& node, const std::string& name);
  void replace(const XmlNode& node, const std::string& element);
  void set_content(const XmlNode& node, const std::string& content);
  enum class Where { first, last };
  /// New elements on lines of their own, indented as their neighbours are.
  void insert(const XmlNode& parent, const std::vector<std::string>& elements, Where where);

  std::string edited() const;

 private:
  struct Edit {
    std::size_t begin, end;
    std::string text;
  };
  std::string indentation(std::size_t position) const;

  std::string text_;
  XmlNode root_;
  std::vector<Edit> edits_;
};

}  // namespace plumbline::model
