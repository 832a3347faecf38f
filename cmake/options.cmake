# Language, options, and what every target of ours is compiled with: for the whole checkout and for core alone.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug" FORCE)
endif()

option(TRAYGAUGE_PAPER "Build profile paper, the method as published; without it --profile paper is refused" ON)
option(TRAYGAUGE_PRECOMPILED_HEADERS "Parse the headers of libraries once for all sources; OFF shows which source forgets an include" ON)
option(TRAYGAUGE_WERROR "Warnings are errors; the presets switch it on" OFF)
option(TRAYGAUGE_LINT "Compile commands for clang-tidy, which does not read all of GCC's flags" OFF)
set(TRAYGAUGE_SANITIZERS "" CACHE STRING "Sanitizers for all targets, e.g. address,undefined or thread")

# Third-party headers are SYSTEM includes, so warnings spare them.
add_library(traygauge_options INTERFACE)
target_compile_options(traygauge_options INTERFACE
  -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Wnon-virtual-dtor -Wold-style-cast
  $<$<BOOL:${TRAYGAUGE_WERROR}>:-Werror>
  -ffp-contract=off)  # no fused multiply-add, so that processors differ less: Eigen's own code for ARM still has some
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 14
    AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 15)
  # Debian 13's GCC 14.2 takes stores for dead that a called function reads: five_point_test then compares with matrices that were
  # never written. GCC 12 and 15 do not, and stdexec met the same (its pull request 2155).
  target_compile_options(traygauge_options INTERFACE -fno-ipa-modref)
endif()
target_include_directories(traygauge_options INTERFACE ${TRAYGAUGE_ROOT})
# Wherever the checkout lies, the programs are the same, and do not tell where it lay.
target_compile_options(traygauge_options INTERFACE
  -ffile-prefix-map=${TRAYGAUGE_ROOT}=. -ffile-prefix-map=${CMAKE_BINARY_DIR}=build)
if(NOT TRAYGAUGE_SANITIZERS)
  # A program holds no function that it does not use, however sources are merged.
  target_compile_options(traygauge_options INTERFACE -ffunction-sections -fdata-sections)
  target_link_options(traygauge_options INTERFACE LINKER:--gc-sections)
endif()

if(TRAYGAUGE_SANITIZERS)
  target_compile_options(traygauge_options INTERFACE
    -fsanitize=${TRAYGAUGE_SANITIZERS} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(traygauge_options INTERFACE -fsanitize=${TRAYGAUGE_SANITIZERS})
  if(TRAYGAUGE_SANITIZERS MATCHES address)
    target_compile_definitions(traygauge_options INTERFACE TRAYGAUGE_ADDRESS_SANITIZER)  # compilers name it differently
  endif()
  if(TRAYGAUGE_SANITIZERS MATCHES undefined)
    # More than a third of the time to compile Eigen's templates goes into these. The address sanitizer meets null pointers and what
    # leaves an object as well, Eigen asserts its alignment, and there is no downcast to check.
    target_compile_options(traygauge_options INTERFACE -fno-sanitize=null,alignment,object-size,vptr)
  endif()
endif()

# traygauge_precompile(TARGET header…): what libraries declare is parsed once for all sources. Where sources are edited, it would
# hide which of them forgets an include.
function(traygauge_precompile target)
  if(TRAYGAUGE_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
