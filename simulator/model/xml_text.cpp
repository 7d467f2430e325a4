#include "simulator/model/xml_text.h"

#include <algorithm>
#include <utility>

#include "simulator/trace/error.h"

namespace plumbline::model {
namespace {

constexpr const char* kSpaces = " \t\r\n";

/// Finds elements by their brackets; comments, CDATA, declarations and instructions are passed over.
class Scanner {
 public:
  Scanner(const std::string& file, const std::string& text) : file_(file), text_(text) {}

  XmlNode root() {
    XmlNode holder;
    content(holder);
    if (holder.children.size() != 1) {
      refuse();
    }
    return std::move(holder.children.front());
  }

 private:
  [[noreturn]] void refuse() const {
    const auto upto = text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size()));
    const auto line = 1 + static_cast<int>(std::count(text_.begin(), upto, '\n'));
    throw InputError({file_, line, ""}, "text that is no XML", "elements that are opened and closed");
  }

  bool here(const char* what) const {
    return text_.compare(at_, std::char_traits<char>::length(what), what) == 0;
  }

  void pass(const char* end) {
    const std::size_t found = text_.find(end, at_);
    if (found == std::string::npos) {
      refuse();
    }
    at_ = found + std::char_traits<char>::length(end);
  }

  /// Up to the end tag of `parent`, or the end of the text.
  void content(XmlNode& parent) {
    while (true) {
      at_ = text_.find('<', at_);
      if (at_ == std::string::npos || here("</")) {
        at_ = std::min(at_, text_.size());
        parent.content_end = at_;
        return;
      }
      if (here("<!--")) {
        pass("-->");
      } else if (here("<![CDATA[")) {
        pass("]]>");
      } else if (here("<?") || here("<!")) {
        pass(">");
      } else {
        parent.children.push_back(element());
      }
    }
  }

  XmlNode element() {
    XmlNode node;
    node.begin = at_++;
    node.name_end = text_.find_first_of(" \t\r\n/>", at_);
    if (node.name_end == std::string::npos) {
      refuse();
    }
    node.name = text_.substr(at_, node.name_end - at_);
    at_ = node.name_end;
    attributes(node);
    node.empty_tag = here("/>");
    at_ += node.empty_tag ? 2 : 1;
    node.open_end = node.content_end = node.end = at_;
    if (!node.empty_tag) {
      content(node);
      if (!here(("</" + node.name).c_str())) {
        refuse();
      }
      pass(">");
      node.end = at_;
    }
    return node;
  }

  void attributes(XmlNode& node) {
    while (true) {
      at_ = text_.find_first_not_of(kSpaces, at_);
      if (at_ == std::string::npos) {
        refuse();
      }
      if (here("/>") || here(">")) {
        return;
      }
      XmlAttribute one;
      one.begin = at_;
      const std::size_t equals = text_.find('=', at_);
      const std::size_t quote = text_.find_first_of("\"'", at_);
      if (equals == std::string::npos || quote == std::string::npos || quote < equals) {
        refuse();
      }
      one.name = text_.substr(at_, text_.find_first_of(" \t\r\n=", at_) - at_);
      one.value_begin = quote + 1;
      one.value_end = text_.find(text_[quote], one.value_begin);
      if (one.value_end == std::string::npos) {
        refuse();
      }
      one.end = at_ = one.value_end + 1;
      node.attributes.push_back(std::move(one));
    }
  }

  std::string file_;
  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace

const XmlAttribute* XmlNode::attribute(const std::string& wanted) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const XmlAttribute& one) { return one.name == wanted; });
  return found == attributes.end() ? nullptr : &*found;
}

const XmlNode* XmlNode::child(const std::string& wanted) const {
  const auto found =
      std::find_if(children.begin(), children.end(), [&](const XmlNode& one) { return one.name == wanted; });
  return found == children.end() ? nullptr : &*found;
}

std::vector<const XmlNode*> XmlNode::all(const std::string& wanted) const {
  std::vector<const XmlNode*> list;
  for (const XmlNode& one : children) {
    if (one.name == wanted) {
      list.push_back(&one);
    }
  }
  return list;
}

XmlText::XmlText(const std::string& file, std::string text) : text_(std::move(text)) {
  root_ = Scanner(file, text_).root();
}

std::string XmlText::value(const XmlNode& node, const std::string& attribute) const {
  const XmlAttribute* found = node.attribute(attribute);
  return found == nullptr ? "" : text_.substr(found->value_begin, found->value_end - found->value_begin);
}

void XmlText::set_attribute(const XmlNode& node, const std::string& name, const std::string& value) {
  if (const XmlAttribute* found = node.attribute(name)) {
    edits_.push_back({found->value_begin, found->value_end, value});
    return;
  }
  const std::size_t at = node.attributes.empty() ? node.name_end : node.attributes.back().end;
  edits_.push_back({at, at, " " + name + "=\"" + value + "\""});
}

void XmlText::remove_attribute(const XmlNode& node, const std::string& name) {
  if (const XmlAttribute* found = node.attribute(name)) {
    const std::size_t space = text_.find_last_not_of(kSpaces, found->begin - 1) + 1;
    edits_.push_back({space, found->end, ""});
  }
}

void XmlText::replace(const XmlNode& node, const std::string& element) {
  edits_.push_back({node.begin, node.end, element});
}

void XmlText::set_content(const XmlNode& node, const std::string& content) {
  if (node.empty_tag) {
    edits_.push_back({node.open_end - 2, node.open_end, ">" + content + "</" + node.name + ">"});
  } else {
    edits_.push_back({node.open_end, node.content_end, content});
  }
}

/// The new line and the spaces before what stands first on its line; empty when something stands before it.
std::string XmlText::indentation(std::size_t position) const {
  const std::size_t line = text_.find_last_of('\n', position);
  if (line == std::string::npos || position == 0) {
    return "";
  }
  const std::string before = text_.substr(line + 1, position - line - 1);
  if (before.find_first_not_of(" \t") != std::string::npos) {
    return "";
  }
  return (line > 0 && text_[line - 1] == '\r' ? "\r\n" : "\n") + before;
}

void XmlText::insert(const XmlNode& parent, const std::vector<std::string>& elements, Where where) {
  std::string text;
  if (parent.children.empty()) {
    const std::string outer = indentation(parent.begin);
    for (const std::string& element : elements) {
      text += (outer.empty() ? "" : outer + "  ") + element;
    }
    if (parent.empty_tag) {
      set_content(parent, text + outer);
    } else {
      edits_.push_back({parent.open_end, parent.open_end, text});
    }
    return;
  }
  if (where == Where::first) {
    const std::size_t at = parent.children.front().begin;
    for (const std::string& element : elements) {
      text += element + indentation(at);
    }
    edits_.push_back({at, at, text});
    return;
  }
  for (const std::string& element : elements) {
    text += indentation(parent.children.back().begin) + element;
  }
  const std::size_t at = parent.children.back().end;
  edits_.push_back({at, at, text});
}

std::string XmlText::edited() const {
  std::vector<Edit> ordered = edits_;
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
  std::string result;
  std::size_t done = 0;
  for (const Edit& edit : ordered) {
    result += text_.substr(done, edit.begin - done) + edit.text;
    done = edit.end;
  }
  return result + text_.substr(done);
}

}  // namespace plumbline::model
