/** Folder of the package beside the scripts, and the script of the worker; set by the builder. */
declare const EPIPOLE_VISION: string;
declare const EPIPOLE_SANDBOX: string;
