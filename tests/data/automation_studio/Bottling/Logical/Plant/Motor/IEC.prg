<?xml version="1.0" encoding="utf-8"?>
<?AutomationStudio Version=4.12.2.93 SP?>
<Program SubType="IEC" xmlns="http://br-automation.co.at/AS/Program">
  <Files>
    <File>Init.st</File>
    <File>Cyclic.ld</File>
    <File Private="true">Motor.var</File>
  </Files>
</Program>