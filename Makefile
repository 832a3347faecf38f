# make build | demo | test | bench: each installs what config/packages.txt names and is missing, then does it.
# make verify-demo: the acceptance test on rendered pictures, from the PDF of the bodies to the certificate; half an hour.
# make board-test: the drivers and the station on a real kernel in an emulated machine; BOARD=arm64 cross-builds for it.
# make board-systemd: a part of it: systemd boots the installed units with no camera, which is then plugged in.
# make arm-test: cross-builds for 64-bit ARM, runs tests and compares volumes under user-mode emulation.
# make test-debian13: builds and tests in a Debian 13, whatever this machine is.
# make soak: the long runs of station and hub: power cuts, kills, fuzzing, trays in a row; two to three hours. Sizes: SOAK_….
# make package: Debian packages for this machine's release, in build-package; BOARD=arm64 cross-builds them.
# make package-debian13: the same in a Debian 13. make package-test: packages of both releases, each tried in a fresh system. With
# BOARD=arm64 these are cross-built and tried under emulation.
# make train: renders, trains and writes the network for food (simulator/training/README.md); up to three hours.
# make lint | format | sanitize: further checks; lint takes a quarter of an hour. CI=true adds to `make test` clang-tidy on what
# the last commit changed, the sanitizers, ARM, and the drivers on a real kernel.

JOBS ?= $(shell nproc)
# Recorded captures, which many tests measure. Without them these tests say skipped; on CI that is a failure.
TRAYGAUGE_CAPTURES ?= $(abspath ../shared/captures)
export TRAYGAUGE_CAPTURES

options := $(if $(shell command -v ccache),-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
# One test of ctest a program: most cases end sooner than a program has started.
ifeq ($(CI),true)
options += -DTRAYGAUGE_WHOLE_TESTS=ON
endif
# On CI the sanitizers and ARM are built without profile paper: it is no part of what is shipped, and this build is so tested,
# too.
paper = -DTRAYGAUGE_PAPER=$(if $(filter true,$(CI)),OFF,ON)
# What comes next, and when it began.
say = @echo "== $$(date +%T) $(1)"
sources = git ls-files '*.cpp' '*.hpp'
ctest = ctest --output-on-failure --no-tests=error -j $(JOBS) -LE '^bench$$'

.PHONY: configure build build-all demo verify-demo test test-programs golden bench board-test board-packages board-guest arm-sysroot board-programs board-drivers board-gpiod-2 board-station board-systemd board-power-cuts arm-test test-debian13 lint lint-changed format check-format check-captures sanitize asan-ubsan tsan soak soak-station soak-cuts soak-kills fuzz fuzz-programs soak-trays packages clang-packages page-packages package package-debian13 package-test train train-packages clean

configure: packages
	cmake --preset release $(options)

build: configure
	cmake --build --preset release -j $(JOBS) --target traygauge

build-all: configure
	cmake --build --preset release -j $(JOBS)

# A hub and a simulated station until Ctrl-C. DEMO_SCANS=2: ends by itself. DEMO_LISTEN=127.0.0.1:9000: another address.
demo: build
	simulator/run_demo.sh build

# The whole protocol of traygauge verify with exactly known bodies, outlines found in the pictures as a station finds them.
# What was rendered or measured already is kept in VERIFY_OUT. VERIFY_RENDER=--reduced: pictures of a quarter of the size.
VERIFY_OUT ?= build/verify-demo
VERIFY_RENDER ?=
verify-demo: configure
	cmake --build --preset release -j $(JOBS) --target traygauge traygauge-simulate
	mkdir -p $(VERIFY_OUT)
	build/traygauge verify bodies -o $(VERIFY_OUT)/bodies.pdf
	test -f $(VERIFY_OUT)/plan.toml || build/traygauge verify plan -o $(VERIFY_OUT)/plan.toml --length-sigma 0
	build/traygauge-simulate verify $(VERIFY_OUT)/plan.toml --out $(VERIFY_OUT)/captures $(VERIFY_RENDER)
	build/traygauge verify run $(VERIFY_OUT)/plan.toml -o $(VERIFY_OUT)/results.jsonl --captures $(VERIFY_OUT)/captures \
	  --labels auto --tester "make verify-demo"
	build/traygauge verify report $(VERIFY_OUT)/results.jsonl -o $(VERIFY_OUT)/certificate

# On CI what the board and ARM need is fetched beside the build.
test-programs: page-packages $(if $(filter true,$(CI)),train-packages)
	$(call say,building: some ten minutes on two cores when all is new)
ifeq ($(CI),true)
	$(MAKE) -j 3 build-all board-guest arm-sysroot
else
	$(MAKE) build-all
endif

test: check-captures test-programs
	$(call say,tests: some eight minutes)
	$(ctest) --test-dir build
	$(MAKE) check-format
ifeq ($(CI),true)
	$(call say,clang-tidy on what changed)
	$(MAKE) lint-changed
	$(call say,sanitizers)
	$(MAKE) sanitize
	$(call say,64-bit ARM)
	$(MAKE) arm-test
	$(call say,drivers on a real kernel)
	$(MAKE) board-drivers
endif
	$(call say,all passed)

# Accepts what is measured now as golden numbers: review the diff.
golden: check-captures build-all
	TRAYGAUGE_GOLDEN_UPDATE=1 build/tests/golden/golden_test
	TRAYGAUGE_GOLDEN_UPDATE=1 tests/package/demo_volumes.sh build/traygauge-station simulator/demo tests/package/demo_volumes.txt

# Benchmarks are tests with the label bench: they print figures and run alone.
bench: build-all
	ctest --test-dir build -L '^bench$$' -V --no-tests=error

# What is downloaded and built for it stays in build-board. BOARD_UNPLUGS=100: how often the camera is pulled out.
BOARD ?= amd64
BOARD_TARGETS = traygauge drivers_test board_test station_cycle $(if $(filter amd64,$(BOARD)),boot_unplugged)
board_preset = $(if $(filter arm64,$(BOARD)),aarch64,release)
board_build = $(if $(filter arm64,$(BOARD)),build-aarch64,build)
arm_sysroot = $(abspath build-board/sysroot-arm64)
board_sysroot = $(if $(filter arm64,$(BOARD)),$(arm_sysroot))
board_guest = build-board/guest-$(BOARD)
in_board = SYSROOT=$(board_sysroot) tests/board/run_guest.sh $(BOARD) $(board_guest)
board-test: board-drivers board-gpiod-2 board-station board-systemd

board-packages: packages
	config/install_packages.sh tests/board/packages.txt

board-guest: board-packages
	tests/board/make_guest.sh $(BOARD) $(board_guest)

arm-sysroot: board-packages
	tests/board/make_sysroot.sh $(arm_sysroot)

board-programs: board-guest $(if $(board_sysroot),arm-sysroot)
	cmake --preset $(board_preset) $(options)
	cmake --build --preset $(board_preset) -j $(JOBS) --target $(BOARD_TARGETS)

board-drivers: board-programs
	$(in_board) tests/board/drivers.sh $(board_build)/tests/drivers/drivers_test $(board_build)/tests/board/board_test \
	  simulator/demo/mash_and_meatballs/view_0.jpg

# From a package for this machine's architecture; with the other, Debian 12's libgpiod alone is met.
board-gpiod-2: board-programs
ifeq ($(BOARD),amd64)
	tests/board/make_gpiod_2.sh build-board/gpiod-2
	cmake --preset gpiod-2 $(options)
	cmake --build --preset gpiod-2 -j $(JOBS) --target drivers_test board_test
	$(in_board) tests/board/gpio.sh build-gpiod-2/tests/drivers/drivers_test build-gpiod-2/tests/board/board_test
endif

board-station: board-programs
	$(in_board) tests/board/station.sh $(board_build)/traygauge $(board_build)/traygauge-station \
	  $(board_build)/tests/board/station_cycle simulator/demo/mash_and_meatballs config/network

# On this machine's architecture alone. BOARD_NO_MODULES=1 does not install modules-load.conf: then it has to fail.
board_systemd = build-board/systemd-$(BOARD)
board-systemd: board-programs
ifeq ($(BOARD),amd64)
	tests/board/make_systemd.sh $(BOARD) $(board_guest) $(board_systemd)
	tests/board/run_guest.sh $(BOARD) $(board_systemd) tests/board/systemd.sh \
	  $(addprefix $(board_build)/,traygauge traygauge-station traygauge-hub tests/board/boot_unplugged) \
	  tests/board/install.sh config/systemd config/60-traygauge-gpio.rules simulator/demo/mash_and_meatballs
endif

# The power of an emulated machine is cut while it runs station and hub under load, POWER_CUTS=100 times: power_cuts.py.
power_programs = traygauge-hub tests/board/cut_station tests/board/cut_check tests/board/no_sync.so
board-power-cuts: override BOARD = amd64
board-power-cuts: board-guest
	cmake --preset release $(options)
	cmake --build --preset release -j $(JOBS) --target traygauge-hub cut_station cut_check no_sync
	tests/board/pack_guest.sh amd64 $(board_guest) build-board/power-cuts.cpio tests/board/power_cuts.sh \
	  $(addprefix build/,$(power_programs)) /sbin/e2fsck
	tests/board/power_cuts.py $(board_guest) build-board/power-cuts.cpio

# The cross-build under user-mode emulation: tests of the core without captures, the drivers' tests, and the volumes that the station
# measures of the demo's trays. Not the alignment of the card, which takes minutes: the volumes depend on the card's place. On CI
# tests of the core whose results show in those volumes are left out. `BOARD=arm64 make package` builds the other programs.
ARM_TESTS = base_test geometry_test image_test network_test features_test tracking_test pixels_test v4l2_test gpio_test serial_test drivers_test \
  $(if $(filter true,$(CI)),,card_test adjustment_test dish_test segmentation_test stereo_test paper_sparse_test)
arm_libraries = /usr/lib/aarch64-linux-gnu
in_arm = qemu-aarch64-static -L $(arm_sysroot) -E LD_LIBRARY_PATH=$(arm_libraries)/blas:$(arm_libraries)/lapack
arm-test: arm-sysroot
	cmake --preset aarch64 $(options) $(paper)
	cmake --build --preset aarch64 -j $(JOBS) --target traygauge-station $(ARM_TESTS)
	printf '%s\n' $(ARM_TESTS) | xargs -P $(JOBS) -I TEST \
	  env TRAYGAUGE_CAPTURES= sh -c '$(in_arm) "$$(find build-aarch64/tests -type f -name TEST)" --gtest_brief=1 --gtest_filter=-CardAlignment*'
	RUN='$(in_arm)' tests/package/demo_volumes.sh build-aarch64/traygauge-station simulator/demo tests/package/demo_volumes.txt

# The packages stay in build-package/ARCHITECTURE/packages. A commit's packages are the same whenever they are made.
SOURCE_DATE_EPOCH ?= $(shell git log -1 --format=%ct 2>/dev/null || echo 0)
package_build = build-package/$(BOARD)
package_preset = $(if $(filter arm64,$(BOARD)),package-arm64,package)
package_targets = traygauge traygauge-simulate traygauge-manual
package: export SOURCE_DATE_EPOCH := $(SOURCE_DATE_EPOCH)
package: packages $(if $(filter arm64,$(BOARD)),arm-sysroot)
	cmake --preset $(package_preset) $(options)
	cmake --build $(package_build) -j $(JOBS) --target $(package_targets)
	$(if $(filter arm64,$(BOARD)),cmake/find_depends.py $(package_build))
	rm -rf $(package_build)/packages
	cd $(package_build) && umask 022 && cpack

# Its root is that of test-debian13.
package-debian13: packages
	config/install_packages.sh tests/debian13/packages.txt
	OPTIONS='$(OPTIONS)' COMMIT="$$(git describe --always --exclude='*' --abbrev=12 --dirty=+changes)" \
	  SOURCE_DATE_EPOCH=$(SOURCE_DATE_EPOCH) tests/package/package_debian13.sh build-debian13 $(BOARD) build-package/debian13-$(BOARD)

package-test: package package-debian13
	config/install_packages.sh tests/package/packages.txt
	tests/package/test_packages.sh build-package/roots bookworm $(BOARD) $(package_build)/packages
	tests/package/test_packages.sh build-package/roots trixie $(BOARD) build-package/debian13-$(BOARD)

# Each part is a target of its own; a failure ends it. Fuzzing runs beside the others; it is built with clang, sanitizers on,
# and goes on from the corpora of the last run in build-fuzz/fuzz.
SOAK_CRASH_POINTS ?= 100000
SOAK_KILLS ?= 1000
SOAK_FUZZ_RUNS ?= 10000000
SOAK_TRAYS ?= 10000
soak: fuzz-programs
	$(MAKE) -j 2 fuzz soak-station
	$(call say,all of it passed)

# One after the other, whatever -j says.
soak-station:
	$(MAKE) -j 1 soak-cuts soak-kills soak-trays

soak-cuts: configure
	cmake --build --preset release -j $(JOBS) --target journal_power_cut_test store_crash_test
	$(call say,power cuts: $(SOAK_CRASH_POINTS) states of the disk for each test of the journal and of the store: some seven minutes)
	TRAYGAUGE_CRASH_POINTS=$(SOAK_CRASH_POINTS) build/tests/firmware/journal/journal_power_cut_test --gtest_brief=1
	TRAYGAUGE_CRASH_POINTS=$(SOAK_CRASH_POINTS) build/tests/firmware/store/store_crash_test --gtest_brief=1

soak-kills: configure
	cmake --build --preset release -j $(JOBS) --target kill_test
	$(call say,station and hub killed at $(SOAK_KILLS) moments: some two minutes)
	TRAYGAUGE_KILLS=$(SOAK_KILLS) build/tests/firmware/hub/kill_test --gtest_brief=1

# Targets at a time; FUZZ_TARGETS=hub_socket takes that one alone, with its share of the runs.
FUZZ_JOBS ?= $(JOBS)
export FUZZ_JOBS FUZZ_TARGETS
fuzz-programs: clang-packages
	cmake --preset debug -B build-fuzz -DCMAKE_CXX_COMPILER=clang++ -DTRAYGAUGE_SANITIZERS=address,undefined \
	  -DTRAYGAUGE_PRECOMPILED_HEADERS=OFF -DTRAYGAUGE_PAPER=OFF -DCMAKE_CXX_FLAGS=-fsanitize=fuzzer-no-link \
	  -DCMAKE_CXX_FLAGS_DEBUG='-O1 -g1' $(options)
	cmake --build build-fuzz -j $(JOBS) --target fuzz_targets

fuzz: fuzz-programs
	$(call say,fuzzing: $(SOAK_FUZZ_RUNS) runs over all targets: half an hour)
	tests/fuzz/run_fuzz.sh build-fuzz $(SOAK_FUZZ_RUNS)

soak-trays: build
	$(call say,$(SOAK_TRAYS) trays in a row on simulated devices: three quarters of an hour)
	tests/soak/trays.py build simulator/demo $(SOAK_TRAYS)

# Builds and tests in a Debian 13 beside this machine's, which stays in build-debian13: half an hour on two cores.
test-debian13: packages
	config/install_packages.sh tests/debian13/packages.txt
	tests/debian13/test_debian13.sh build-debian13

packages:
	@config/install_packages.sh

# The browser, which is larger than all others together, what checks the hub's figures, a database, and a broker that is a cluster.
page-packages: packages
	@config/install_packages.sh tests/page/packages.txt
	@config/install_packages.sh tests/firmware/collect/packages.txt
	@tests/firmware/api/get_promtool.sh build/promtool
	@tests/firmware/collect/get_nats.sh build/nats

# Compiles Eigen's templates with sanitizers in half of GCC's time.
clang-packages: packages
	@config/install_packages.sh tests/clang_packages.txt

# Torch, for the training and for the test that trains a toy.
train-packages: packages
	@config/install_packages.sh simulator/training/packages.txt

# Stopped, it goes on where it was. TRAIN_OPTIONS='--photographs FOLDER' also measures on photographs.
TRAIN_OUT ?= config/network/food.tgn
train: configure train-packages
	cmake --build --preset release -j $(JOBS) --target traygauge-simulate
	mkdir -p build-train $(dir $(TRAIN_OUT))
	/usr/bin/python3 simulator/training/train.py --work build-train --out $(TRAIN_OUT) --renderer build/traygauge-simulate \
	  $(TRAIN_OPTIONS)

check-captures:
ifeq ($(CI),true)
	@test -d '$(TRAYGAUGE_CAPTURES)' || { echo 'No captures in $(TRAYGAUGE_CAPTURES): their tests would be skipped.' >&2; exit 1; }
endif

check-format: packages
	$(sources) | xargs clang-format --dry-run --Werror

format: packages
	$(sources) | xargs clang-format -i

# clang-tidy over everything that is shipped; LINT_FILES='core/stereo/' for a part of it. It reads the commands of a build
# without precompiled headers, because clang cannot read GCC's.
LINT_FILES ?= (core|drivers|simulator|firmware)/
lint: packages
	cmake --preset lint
	run-clang-tidy -quiet -j $(JOBS) -p build-lint '^$(CURDIR)/$(LINT_FILES)' >build-lint/lint.log 2>&1 || \
	  { grep -A 3 -E '(error|warning): ' build-lint/lint.log; echo 'All of it: build-lint/lint.log' >&2; exit 1; }

# The same over what the last commit changed, or what changed since LINT_SINCE.
LINT_SINCE ?= HEAD~1
lint-changed: packages
	cmake --preset lint
	@changed=$$(git diff --name-only --diff-filter=d $(LINT_SINCE) -- 'core/*.cpp' 'drivers/*.cpp' 'simulator/*.cpp' 'firmware/*.cpp'); \
	if [ -z "$$changed" ]; then echo 'No source changed since $(LINT_SINCE).'; else \
	  echo "$$changed" | xargs -P $(JOBS) -n 4 clang-tidy --quiet -p build-lint; fi

sanitize: asan-ubsan tsan

# On CI what reads pictures, files, messages and devices, with what is fuzzed of them, and the estimator, which leads through all of
# core. Tests of its stages and the other programs are left to `make sanitize`.
ASAN_TESTS = $(addsuffix _test,image labels network pipeline estimator capture simulated_devices drivers pixels v4l2 gpio serial \
  firmware_base journal journal_power_cut web) web_request_fuzz message_fuzz journal_fuzz network_file_fuzz
empty =
some_tests = $(if $(filter true,$(CI)),$(1))
asan-ubsan: clang-packages
	cmake --preset asan-ubsan $(options) $(paper)
	cmake --build --preset asan-ubsan -j $(JOBS) $(call some_tests,--target $(ASAN_TESTS))
	$(ctest) --test-dir build-asan-ubsan $(call some_tests,-R '^($(subst $(empty) $(empty),|,$(strip $(ASAN_TESTS))))$$')

# Where there is concurrency: the devices, and on demand the station that measures in a thread of its own.
TSAN_TESTS = drivers_test gpio_test serial_test v4l2_test simulated_devices_test $(if $(filter true,$(CI)),,station_test)
tsan: clang-packages
	cmake --preset tsan $(options)
	cmake --build --preset tsan -j $(JOBS) --target $(TSAN_TESTS)
	printf '%s\n' $(TSAN_TESTS) | xargs -P $(JOBS) -I TEST sh -c '"$$(find build-tsan -type f -name TEST)" --gtest_brief=1'

clean:
	rm -rf build build-debug build-lint build-asan-ubsan build-tsan build-aarch64 build-gpiod-2 build-board build-debian13 build-fuzz build-package build-train
