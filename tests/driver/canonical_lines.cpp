// Each line of standard input is JSON; its canonical form comes out.
#include <iostream>
#include <string>

#include "controllers/driver/json.h"

int main() {
  std::string line;
  while (std::getline(std::cin, line)) {
    std::cout << plumbline::driver::canonical_json(plumbline::driver::parse_json(line)) << '\n';
  }
  return 0;
}
