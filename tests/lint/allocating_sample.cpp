// What the core library must not do, for the test of the test: each way to allocate in a function of its own.
#include <cstdlib>

namespace traygauge {

int* sample_new(int n) {
  return new int(n);
}
int* sample_new_array(std::size_t n) {
  return new int[n];
}
void sample_delete(int* p) {
  delete p;
}
void* sample_malloc(std::size_t n) {
  return std::malloc(n);
}
void* sample_calloc(std::size_t n) {
  return std::calloc(n, 2);
}
void* sample_realloc(void* p, std::size_t n) {
  return std::realloc(p, n);
}
void sample_free(void* p) {
  std::free(p);
}
void sample_throw() {
  throw 1;
}

}  // namespace traygauge
