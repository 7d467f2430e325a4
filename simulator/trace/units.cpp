#include "simulator/trace/units.h"

#include <udunits2.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <regex>
#include <stdexcept>

#include "simulator/trace/error.h"

namespace plumbline {
namespace {

constexpr std::size_t kLongestUnit = 64;

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

/// udunits' database. The library is not safe for threads: hold the mutex for every call.
class Database {
 public:
  Database() {
    ut_set_error_message_handler(ut_ignore);  // udunits writes to standard error by default
    system_ = ut_read_xml(nullptr);
    if (system_ == nullptr) {
      throw std::runtime_error(
          "the unit database of udunits2 cannot be read; is libudunits2 installed whole?");
    }
    const Unit degree(ut_get_unit_by_name(system_, "degree"));
    if (degree != nullptr) {
      ut_map_name_to_unit("deg", UT_ASCII, degree.get());  // the abbreviation that robotics uses
    }
  }
  ~Database() { ut_free_system(system_); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  Unit parse(const std::string& text) const { return Unit(ut_parse(system_, text.c_str(), UT_UTF8)); }
  std::mutex& mutex() { return mutex_; }

 private:
  ut_system* system_ = nullptr;
  std::mutex mutex_;
};

Database& database() {
  static Database the_database;
  return the_database;
}

/// What a visit of a unit's definition collects: value_SI = factor * value.
struct Conversion {
  double factor = 1.0;
  bool proportional = true;
};

Conversion& conversion(void* argument) { return *static_cast<Conversion*>(argument); }

ut_status visit_basic(const ut_unit* /*unit*/, void* /*argument*/) { return UT_SUCCESS; }

ut_status visit_product(const ut_unit* /*unit*/, int /*count*/, const ut_unit* const* /*basic*/,
                        const int* /*powers*/, void* /*argument*/) {
  return UT_SUCCESS;  // a product of SI base units: factor 1
}

ut_status visit_galilean(const ut_unit* unit, double scale, const ut_unit* underlying, double offset,
                         void* argument);

ut_status visit_timestamp(const ut_unit* /*unit*/, const ut_unit* /*time*/, double /*origin*/,
                          void* argument) {
  conversion(argument).proportional = false;
  return UT_SUCCESS;
}

ut_status visit_logarithmic(const ut_unit* /*unit*/, double /*base*/, const ut_unit* /*reference*/,
                            void* argument) {
  conversion(argument).proportional = false;
  return UT_SUCCESS;
}

const ut_visitor kVisitor{visit_basic, visit_product, visit_galilean, visit_timestamp, visit_logarithmic};

ut_status visit_galilean(const ut_unit* /*unit*/, double scale, const ut_unit* underlying, double offset,
                         void* argument) {
  conversion(argument).factor *= scale;
  conversion(argument).proportional = conversion(argument).proportional && offset == 0.0;
  return ut_accept_visitor(underlying, &kVisitor, argument);
}

/// udunits reads "m^1.5" as m^1 times 0.5: refuse what it would misread.
bool has_broken_exponent(const std::string& text) {
  static const std::regex pattern(R"([A-Za-z)^*][-+]?\d+\.\d)");
  return std::regex_search(text, pattern);
}

/// The factor to SI, or nothing when the text is no unit or not proportional to one.
std::optional<double> factor_of(const std::string& text, Unit& unit) {
  const bool blank = text.find_first_not_of(' ') == std::string::npos;
  const bool has_control =
      std::any_of(text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; });
  if (blank || has_control || text.size() > kLongestUnit || has_broken_exponent(text)) {
    return std::nullopt;
  }
  unit = database().parse(text);
  Conversion to_si;
  if (unit == nullptr || ut_accept_visitor(unit.get(), &kVisitor, &to_si) != UT_SUCCESS) {
    return std::nullopt;
  }
  const bool usable = to_si.proportional && std::isfinite(to_si.factor) && to_si.factor > 0.0;
  return usable ? std::optional<double>(to_si.factor) : std::nullopt;
}

}  // namespace

bool unit_is_known(const std::string& unit) {
  const std::lock_guard<std::mutex> lock(database().mutex());
  Unit parsed;
  return factor_of(unit, parsed).has_value();
}

bool units_agree(const std::string& a, const std::string& b) {
  const std::lock_guard<std::mutex> lock(database().mutex());
  Unit unit_a;
  Unit unit_b;
  if (!factor_of(a, unit_a) || !factor_of(b, unit_b)) {
    return false;
  }
  // ut_are_convertible() would also accept reciprocals (s and Hz), so look at the quotient instead.
  const Unit quotient(ut_divide(unit_a.get(), unit_b.get()));
  return quotient != nullptr && ut_is_dimensionless(quotient.get()) != 0;
}

double to_si_factor(const std::string& unit) {
  const std::lock_guard<std::mutex> lock(database().mutex());
  Unit parsed;
  const std::optional<double> factor = factor_of(unit, parsed);
  if (!factor) {
    throw InputError({"", 0, "unit"}, "\"" + unit + "\"",
                     "a unit proportional to SI, factors separated by spaces, whole exponents (N m s/rad, kg "
                     "m^2, deg, 1)");
  }
  return *factor;
}

}  // namespace plumbline
