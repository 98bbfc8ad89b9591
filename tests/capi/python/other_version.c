/* A library of another version: of all functions it has one. */
const char* bodice_build(void);

const char* bodice_build(void) {
  return "bodice 0.0.1, ABI " OTHER_ABI ", a compiler";
}
