"""The library as others use it: C, Fortran, Fortran 77 and CMake, installed and packaged, and that all of them say the same."""
