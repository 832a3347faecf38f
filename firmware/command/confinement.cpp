#include "firmware/command/confinement.hpp"

#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>

namespace traygauge {
namespace {

// What neither program needs and what leads around every other rule: other programs, other processes' memory,
// the kernel's insides, and io_uring, which opens and sends without the calls that are filtered.
constexpr auto kNeverNeeded = std::to_array<int>({
  SCMP_SYS(execve), SCMP_SYS(execveat), SCMP_SYS(io_uring_setup), SCMP_SYS(io_uring_enter),
      SCMP_SYS(io_uring_register), SCMP_SYS(process_vm_readv), SCMP_SYS(process_vm_writev), SCMP_SYS(bpf),
      SCMP_SYS(perf_event_open), SCMP_SYS(userfaultfd), SCMP_SYS(mount), SCMP_SYS(umount2),
      SCMP_SYS(pivot_root), SCMP_SYS(chroot), SCMP_SYS(setns), SCMP_SYS(unshare), SCMP_SYS(init_module),
      SCMP_SYS(finit_module), SCMP_SYS(delete_module), SCMP_SYS(kexec_load), SCMP_SYS(kexec_file_load),
      SCMP_SYS(reboot), SCMP_SYS(mknod), SCMP_SYS(mknodat), SCMP_SYS(add_key), SCMP_SYS(request_key),
      SCMP_SYS(keyctl),
#if !defined(TRAYGAUGE_ADDRESS_SANITIZER)
      SCMP_SYS(ptrace),  // by which the leak sanitizer stops the threads
#endif
});

class Filter {
 public:
  Filter() : context_(seccomp_init(SCMP_ACT_ALLOW), seccomp_release) {
    if (context_ == nullptr) error_ = ENOMEM;
    // Threads that a library has started are held to it, too.
    if (error_ == 0) error_ = -seccomp_attr_set(context_.get(), SCMP_FLTATR_CTL_TSYNC, 1);
    for (const int call : kNeverNeeded) refuse(call);
  }

  // The call fails with EPERM.
  void refuse(int call) {
    if (error_ == 0) error_ = -seccomp_rule_add_array(context_.get(), kRefused, call, 0, nullptr);
  }
  // The same where its first argument is another one.
  void refuse_all_but(scmp_datum_t first_argument, int call) {
    const scmp_arg_cmp is_other{0, SCMP_CMP_NE, first_argument, 0};
    if (error_ == 0) error_ = -seccomp_rule_add_array(context_.get(), kRefused, call, 1, &is_other);
  }

  Expected<void> load() {
    if (error_ == 0) error_ = -seccomp_load(context_.get());
    if (error_ == 0) return {};
    return Failure{std::string("The kernel takes no filter of system calls (") + std::strerror(error_) +
                   "): only the service's unit keeps this program from what it does not need."};
  }

 private:
  static constexpr std::uint32_t kRefused = SCMP_ACT_ERRNO(EPERM);

  std::unique_ptr<void, decltype(&seccomp_release)> context_;
  int error_ = 0;
};

void leave_no_core_dump() {
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  // A handler of core dumps ignores the limit.
  ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
}

}  // namespace

Expected<void> confine_station() {
  leave_no_core_dump();
  Filter filter;
  filter.refuse_all_but(AF_UNIX, SCMP_SYS(socket));
  filter.refuse_all_but(AF_UNIX, SCMP_SYS(socketpair));
  return filter.load();
}

Expected<void> confine_hub() {
  Filter filter;
  // Sockets and files need none.
  filter.refuse(SCMP_SYS(ioctl));
  return filter.load();
}

}  // namespace traygauge
