// Keeps the layer linkable until its first source lands.
