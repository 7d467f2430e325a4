// The readers of files, each as a function from the file's bytes to a verdict.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace plumbline::test {

/// One reader with good texts to start from. `check` returns an empty text when the reader accepted the input
/// with credible results or refused it with one InputError line, otherwise what went wrong.
struct ReaderTarget {
  std::string name;  ///< also the folder below tests/corpus
  std::vector<std::string> seeds;
  std::function<std::string(const std::string& text)> check;
};

/// `folder`: where inputs are put down as files; the input being read stays there when a reader crashes.
std::vector<ReaderTarget> reader_targets(const std::string& folder);

}  // namespace plumbline::test
