# What ./prospect test --asan and --tsan tell the sanitizers' runtimes.

# sanitizer_options PRESET
sanitizer_options() {
  local folder=$ROOT/tests/sanitizers
  [ "$1" = release ] || export PROSPECT_TEST_SECONDS=400  # instrumented programs are that much slower
  case "$1" in
    asan)
      # One test preloads a clock that jumps: the runtime is not the first library then. And memory that was given back is
      # kept for less than the soak test's time, or every process grows in it.
      export ASAN_OPTIONS=verify_asan_link_order=0:quarantine_size_mb=8
      export LSAN_OPTIONS=suppressions=$folder/leaks.txt:print_suppressions=0
      export UBSAN_OPTIONS=print_stacktrace=1 ;;
    tsan)
      # What libhdf5 asks for on reading a damaged file is not to be had: without the limits the system ends the process.
      export TSAN_OPTIONS=suppressions=$folder/threads.txt:second_deadlock_stack=1
      TSAN_OPTIONS+=:allocator_may_return_null=1:max_allocation_size_mb=2000 ;;
  esac
}
