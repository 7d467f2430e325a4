#include "simulator/render/vtk_captions.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::render {
namespace {

constexpr double kLetter = 1.0 / 34.0;  // of the picture's height
constexpr double kLetterWidth = 0.54;   // of a letter's height, mean
constexpr double kLeast = 9.0;          // pixels: smaller ones cannot be read
constexpr double kSmall = 0.82;         // of notes and key, in letters
constexpr double kNotes = 0.36;         // share of the width that notes may take

/// In lines of at most so many letters, between words; a longer word has a line of its own.
std::vector<std::string> broken(const std::string& text, std::size_t letters) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (lines.empty() || lines.back().size() + 1 + word.size() > letters) {
      lines.push_back(word);
    } else {
      lines.back() += " " + word;
    }
  }
  return lines;
}

}  // namespace

CaptionActors::CaptionActors(vtkRenderer* renderer, int width, int height)
    : renderer_(renderer), width_(width), height_(height) {}

void CaptionActors::add_text(const std::string& text, int x, int y, double size, bool bold, bool from_top) {
  const vtkSmartPointer<vtkTextActor> actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(text.c_str());
  actor->SetTextScaleModeToNone();
  actor->SetDisplayPosition(x, y);
  vtkTextProperty* property = actor->GetTextProperty();
  property->SetFontFamilyToArial();
  property->SetFontSize(static_cast<int>(std::lround(size)));
  property->SetColor(0.16, 0.19, 0.23);
  property->SetBold(bold ? 1 : 0);
  from_top ? property->SetVerticalJustificationToTop() : property->SetVerticalJustificationToCentered();
  renderer_->AddActor2D(actor);
  actors_.emplace_back(actor);
}

void CaptionActors::add_swatch(const std::vector<Color>& colors, int x, int y, int width, int height) {
  const auto n = static_cast<int>(colors.size());
  for (int k = 0; k < n; ++k) {
    const double from = x + static_cast<double>(width) * k / n;
    const double to = x + static_cast<double>(width) * (k + 1) / n;
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(from, y, 0.0);
    points->InsertNextPoint(to, y, 0.0);
    points->InsertNextPoint(to, y + height, 0.0);
    points->InsertNextPoint(from, y + height, 0.0);
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({0, 1, 2, 3});
    vtkNew<vtkPolyData> quad;
    quad->SetPoints(points);
    quad->SetPolys(cells);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(quad);
    const vtkSmartPointer<vtkActor2D> actor = vtkSmartPointer<vtkActor2D>::New();
    actor->SetMapper(mapper);
    const Color& color = colors[static_cast<std::size_t>(k)];
    actor->GetProperty()->SetColor(color.x(), color.y(), color.z());
    renderer_->AddActor2D(actor);
    actors_.push_back(actor);
  }
}

void CaptionActors::write(const Captions& captions) {
  for (const vtkSmartPointer<vtkActor2D>& actor : actors_) {
    renderer_->RemoveActor2D(actor);
  }
  actors_.clear();
  const double letter = std::max(kLeast, kLetter * height_);
  const int margin = static_cast<int>(1.1 * letter);
  double y = height_ - 0.9 * letter;
  if (!captions.title.empty()) {
    add_text(captions.title, margin, static_cast<int>(y), letter, true, true);
    y -= 1.55 * letter;
  }
  for (const std::string& line : captions.lines) {
    add_text(line, margin, static_cast<int>(y), letter, false, true);
    y -= 1.4 * letter;
  }
  const double small = kSmall * letter;
  const auto letters = static_cast<std::size_t>(kNotes * width_ / (kLetterWidth * small));
  for (const std::string& note : captions.notes) {
    for (const std::string& line : broken(note, letters)) {
      add_text(line, margin, static_cast<int>(y), small, false, true);
      y -= 1.4 * small;
    }
  }
  write_key(captions.key, small, margin);
}

/// In the upper right corner, its lines one below the other.
void CaptionActors::write_key(const std::vector<KeyLine>& key, double letter, int margin) {
  std::size_t longest = 0;
  for (const KeyLine& line : key) {
    longest = std::max(longest, line.text.size());
  }
  const int swatch = static_cast<int>(2.6 * letter);
  const int gap = static_cast<int>(0.7 * letter);
  const int left =
      width_ - margin - swatch - gap - static_cast<int>(kLetterWidth * letter * static_cast<double>(longest));
  double y = height_ - 1.9 * letter;
  for (const KeyLine& line : key) {
    add_swatch(line.colors, left, static_cast<int>(y), swatch, static_cast<int>(0.8 * letter));
    add_text(line.text, left + swatch + gap, static_cast<int>(y + 0.4 * letter), letter, false, false);
    y -= 1.45 * letter;
  }
}

}  // namespace plumbline::render
