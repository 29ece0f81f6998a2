#pragma once

namespace prospect::tools {

// A share of trials with its 95 % interval (Wilson's score interval, which holds near 0 and 1).
struct Share {
  int count = 0;
  int total = 0;
  double value = 0;  // count / total; 0 when total is 0
  double low = 0;    // 0..1
  double high = 1;
};

// count of total; 0 <= count <= total.
Share ShareOf(int count, int total);

}  // namespace prospect::tools
