// Signs or verifies standard input: keyed sign|verify KEYFILE CHANNEL

#include "examples/keyed/keyed.h"

#include <iostream>
#include <iterator>

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  Keyed keyed(argv[2]);
  Keyed::Bytes bytes{std::istreambuf_iterator<char>(std::cin), {}};
  if (std::string(argv[1]) == "sign") {
    bytes = keyed.Sign(argv[3], bytes);
  } else if (!keyed.Verify(argv[3], &bytes)) {
    std::cerr << "not authentic\n";
    return 1;
  }
  std::cout.write(reinterpret_cast<const char*>(bytes.data()),
                  static_cast<std::streamsize>(bytes.size()));
  return 0;
}
