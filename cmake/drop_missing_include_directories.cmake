# Cure for ROS 2 wheels, given as -DCMAKE_PROJECT_INCLUDE=<this file>; a stock ROS 2 does not need it.
#
# The exported targets of the wheels name include directories of the machine that built them, and
# CMake refuses imported targets whose include directories do not exist. Once everything is found,
# at the end of the directory, those that do not exist are dropped.

function(drop_missing_include_directories)
  get_property(targets DIRECTORY PROPERTY IMPORTED_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(directories ${target} INTERFACE_INCLUDE_DIRECTORIES)
    if(NOT directories)
      continue()
    endif()
    set(kept)
    foreach(directory IN LISTS directories)
      # Generator expressions cannot be judged here, only plain absolute paths.
      if(NOT IS_ABSOLUTE "${directory}" OR EXISTS "${directory}")
        list(APPEND kept "${directory}")
      endif()
    endforeach()
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${kept}")
  endforeach()
endfunction()

cmake_language(DEFER CALL drop_missing_include_directories)
