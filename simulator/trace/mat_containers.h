// What a MATLAB 5 file says of its structs and cells, looked at before a library makes room for them.
#pragma once

#include <optional>
#include <string>

namespace plumbline {

/// Name of the first uncompressed top-level struct or cell array that claims more elements than the file's
/// bytes could hold (each takes a tag of 8 bytes at least). Nothing when there is none, or when the file is
/// not a MATLAB 5 file in this machine's byte order. Source: MathWorks, MAT-File Format, chapter 1 (level 5:
/// tags, array flags, dimensions, name).
std::optional<std::string> overgrown_container(const std::string& bytes);

}  // namespace plumbline
