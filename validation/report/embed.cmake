# Writes a C++ file that holds the page's files as texts.
# Usage: cmake -DOUT=<file.cpp> -DPAGE=<folder> -DLIBRARY=<folder of the uPlot package> -P embed.cmake
cmake_minimum_required(VERSION 3.25)

# As a raw string. The compiler takes literals of any length; other compilers than GCC may not.
function(add_text name)
  set(text "")
  foreach(file IN LISTS ARGN)
    file(READ "${file}" one)
    string(APPEND text "${one}")
  endforeach()
  string(FIND "${text}" ")PAGE\"" clash)
  if(NOT clash EQUAL -1)
    message(FATAL_ERROR "${ARGN}: found )PAGE\", which ends a raw string")
  endif()
  string(APPEND code "const char* const k_${name} = R\"PAGE(${text})PAGE\";\n\n")
  set(code "${code}" PARENT_SCOPE)
endfunction()

set(code "// Made by embed.cmake.\n#include \"validation/report/page.h\"\n\nnamespace plumbline::validation {\nnamespace {\n\n")
file(GLOB scripts ${PAGE}/*.js)
add_text(html ${PAGE}/page.html)
add_text(style ${PAGE}/page.css)
add_text(script ${scripts})
add_text(library ${LIBRARY}/dist/uPlot.iife.min.js)
add_text(library_style ${LIBRARY}/dist/uPlot.min.css)
add_text(library_licence ${LIBRARY}/LICENSE)
string(APPEND code "}  // namespace\n\nPageFiles page_files() {\n"
  "  return {k_html, k_style, k_script, k_library, k_library_style, k_library_licence};\n}\n\n"
  "}  // namespace plumbline::validation\n")
file(WRITE "${OUT}" "${code}")
